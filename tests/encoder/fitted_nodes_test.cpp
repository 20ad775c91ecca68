// Fits that use a part of a snapshot's nodes, and errors at all of them.
#include "encoder/fitted_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/encoder/bent_snapshot.h"
#include "tests/encoder/fine_snapshot.h"
#include "tests/encoder/synthetic_snapshot.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

constexpr std::size_t most = 3000;

/// At all nodes and frames, by evaluation one by one, over the largest displacement.
double error_at_nodes(const Encoded& encoded, const Series& all) {
  std::optional<NodeResidual> residual;
  if (encoded.residual) residual = decoded(*encoded.residual);
  double worst = 0;
  for (std::size_t j = 0; j < all.times.size(); ++j)
    for (std::size_t n = 0; n < all.samples.size(); ++n) {
      const auto row = all.frames[j].row(static_cast<Eigen::Index>(n));
      Vec3 d = encoded.field.displacement(all.samples[n].uvw, all.samples[n].side, all.times[j]);
      if (residual) d += residual->at(n, j);
      worst = std::max(worst, norm(d - Vec3{row(0), row(1), row(2)}));
    }
  return worst / all.largest_displacement;
}

}  // namespace

TEST(FittedNodes, AreAboutAsManyAsAskedWithTheBreakAndThoseNextToIt) {
  const FineSnapshot fine;
  const Snapshot& s = fine.reader().snapshot();
  const std::vector<Sample> samples = samples_of(s);
  EXPECT_TRUE(fitted_nodes(s, samples, samples.size()).empty());
  const std::vector<std::int32_t> some = fitted_nodes(s, samples, most);
  EXPECT_GT(some.size(), most / 2);
  EXPECT_LT(some.size(), 3 * most / 2);
  EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
  const std::set<std::int32_t> chosen(some.begin(), some.end());
  EXPECT_EQ(chosen.size(), some.size());
  std::size_t on_plane = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    if (samples[n].uvw.y == 0) {
      ++on_plane;
      EXPECT_TRUE(chosen.contains(static_cast<std::int32_t>(n))) << n;
    }
  EXPECT_GT(on_plane, 400u);
  // Every eighth of the body has its share, on each axis.
  for (int axis = 0; axis < 3; ++axis)
    for (int part = 0; part < 8; ++part) {
      const double front = axis == 0   ? -6
                           : axis == 1 ? -5
                                       : -2.5,
                   extent = axis == 0   ? 12
                            : axis == 1 ? 10
                                        : 2.5;
      const auto within = std::count_if(some.begin(), some.end(), [&](std::int32_t n) {
        const double x = (samples[n].uvw[axis] - front) / extent * 8;
        return part <= x && x <= part + 1;
      });
      EXPECT_GT(within, static_cast<std::ptrdiff_t>(some.size() / 40)) << axis << " " << part;
    }
}

TEST(FittedNodes, ErrorsAreThoseOfAllNodes) {
  const FineSnapshot fine;
  const Series all(fine.reader()), part(fine.reader(), {{}, most});
  ASSERT_LT(part.samples.size(), all.samples.size() / 4);
  ASSERT_EQ(part.node_samples().size(), all.samples.size());
  EXPECT_EQ(part.largest, all.largest);
  EXPECT_EQ(part.pairs.size(), all.pairs.size());
  for (std::size_t p = 0; p < all.pairs.size(); ++p)
    for (int lip = 0; lip < 2; ++lip) {
      EXPECT_EQ(part.samples[part.pairs[p][lip]].uvw, all.samples[all.pairs[p][lip]].uvw);
      EXPECT_EQ(part.samples[part.pairs[p][lip]].side, all.samples[all.pairs[p][lip]].side);
    }
  EXPECT_EQ(part.geometry.domain[0].front, all.geometry.domain[0].front);
  EXPECT_EQ(part.quantities[0].scale, all.quantities[0].scale);
  for (const std::size_t first : {std::size_t{0}, std::size_t{777}}) {
    const auto rows = static_cast<Eigen::Index>(500);
    EXPECT_EQ(part.values(NodeSpline::displacement, 3, first, 500),
              Eigen::MatrixXd(all.frames[3].middleRows(static_cast<Eigen::Index>(first), rows)));
    EXPECT_EQ(part.values(0, 3, first, 500), Eigen::MatrixXd(all.quantities[0].frames[3].middleRows(
                                                 static_cast<Eigen::Index>(first), rows)));
  }
  bool with_residual = false;
  for (const double tolerance : {0.05, 0.005}) {
    const Encoded encoded = encoded_within(part, tolerance, "front");
    EXPECT_LE(error_at_nodes(encoded, all), tolerance);
    EXPECT_NEAR(error_at_nodes(encoded, all), encoded.field.report.node_error, 1e-9);
    EXPECT_NEAR(error_at_nodes({encoded.field}, all), encoded.field.report.spline_error, 1e-9);
    EXPECT_EQ(encoded.field.report.nodes, static_cast<double>(all.samples.size()));
    with_residual = with_residual || encoded.residual;
    // A ridge of the temperature, which smooth splines leave, is kept at nodes that were not fitted too.
    ASSERT_TRUE(encoded.of_quantities[0]);
    const NodeResidual of_t = decoded(*encoded.of_quantities[0]);
    double worst = 0;
    for (std::size_t j = 0; j < all.times.size(); ++j)
      for (std::size_t n = 0; n < all.samples.size(); ++n) {
        double t = 0;
        encoded.field.quantity(0, all.samples[n].uvw, all.samples[n].side, all.times[j], {&t, 1});
        worst = std::max(worst, std::abs(t + of_t.at(n, 0, j) -
                                         all.quantities[0].frames[j](static_cast<Eigen::Index>(n), 0)));
      }
    EXPECT_LE(worst, tolerance * all.quantities[0].scale * (1 + 1e-9));
  }
  EXPECT_TRUE(with_residual);
}

/// With six samples a control point already; a million nodes are hundreds.
TEST(FittedNodes, APartDeterminesNearlyTheSameField) {
  const FineSnapshot fine;
  const Series all(fine.reader()), part(fine.reader(), {{}, 2 * most});
  const Rung rung{1, 4, 1, 2, 2, 1, 3};
  const FitReport of_all = encoded_on(all, "front", rung).field.report,
                  of_part = encoded_on(part, "front", rung).field.report;
  EXPECT_LT(of_part.relative_l2, 1.5 * of_all.relative_l2);
  EXPECT_GE(of_part.relative_l2, of_all.relative_l2) << "all is the least of squares";
  EXPECT_LT(of_part.spline_error, 1.5 * of_all.spline_error);
}

TEST(FittedNodes, ValuesOfABentSeriesAreReadInItsAxes) {
  const BentSnapshot bent(opening);
  const SnapshotReader reader(bent.file);
  const Series all(reader), part(reader, {{}, 100});
  ASSERT_LT(part.samples.size(), all.samples.size());
  ASSERT_EQ(part.node_samples().size(), all.nodes);
  for (std::size_t n = 0; n < all.nodes; ++n) EXPECT_EQ(part.node_samples()[n].uvw, all.samples[n].uvw);
  const auto values = part.values(NodeSpline::displacement, 5, 10, all.nodes - 10);
  const auto rows = static_cast<Eigen::Index>(all.nodes - 10);
  EXPECT_LT((values - Eigen::MatrixXd(all.frames[5].middleRows(10, rows))).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace cleft
