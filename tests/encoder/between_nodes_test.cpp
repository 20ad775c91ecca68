// What holds the spline between nodes: centres of cells in the least squares, and knots that data determine.
#include "encoder/between_nodes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "encoder/frame_fit.h"
#include "encoder/supported_rungs.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

constexpr int nu = 12, nv = 10, nw = 5;

/// The usual grid with its hexahedra; those right of v = 0 have the right ones of doubled nodes.
Snapshot grid_with_cells() {
  Snapshot s = cut_in(grid(nu, nv, nw), eight_times);
  std::vector<std::int64_t> right(s.points.size());
  for (std::size_t n = 0; n < right.size(); ++n) right[n] = static_cast<std::int64_t>(n);
  for (const auto& [l, r] : s.pairs) right[l] = r;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      for (int k = 0; k < nw; ++k) {
        for (const auto& [a, b, c] : {std::array{0, 0, 0},
                                      {1, 0, 0},
                                      {1, 1, 0},
                                      {0, 1, 0},
                                      {0, 0, 1},
                                      {1, 0, 1},
                                      {1, 1, 1},
                                      {0, 1, 1}}) {
          const std::int64_t node = ((i + a) * (nv + 1) + j + b) * (nw + 1) + k + c;
          s.connectivity.push_back(2 * j >= nv ? right[node] : node);
        }
        s.cell_types.push_back(12);  // VTK's hexahedron
        s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
      }
  return s;
}

}  // namespace

TEST(BetweenNodes, CentresOfCellsAreMeansOnTheirSide) {
  const Series series = SyntheticSnapshot(grid_with_cells(), opening).series();
  const CellCentres& centres = series.centres;
  ASSERT_EQ(centres.samples.size(), static_cast<std::size_t>(nu * nv * nw));
  const Eigen::MatrixX3d means = centres.mean(series.frames.back());
  std::size_t c = 0;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      for (int k = 0; k < nw; ++k, ++c) {
        const Vec3 at{12 * (i + 0.5) / nu - 6, 10 * (j + 0.5) / nv - 5, 2.5 * (k + 0.5) / nw - 2.5};
        EXPECT_LT(norm(centres.samples[c].uvw - at), 1e-12);
        EXPECT_EQ(centres.touches_plane[c], j == nv / 2 - 1 || j == nv / 2);
        Vec3 mean;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3 p{12. * (i + corner / 4) / nu - 6, 10. * (j + corner / 2 % 2) / nv - 5,
                       2.5 * (k + corner % 2) / nw - 2.5};
          const bool doubled = p.y == 0 && std::abs(p.x) < 4 && p.z > -1.5;
          const Side side = !doubled ? Side::both : at.y < 0 ? Side::left : Side::right;
          mean += 1. / 8 * opening(p, side, 8);
        }
        const auto row = means.row(static_cast<Eigen::Index>(c));
        EXPECT_LT(norm(Vec3{row(0), row(1), row(2)} - mean), 1e-12) << i << ' ' << j << ' ' << k;
      }
}

/// 858 nodes are too few for 1,400 control points at any frame: all centres are in the sums.
TEST(BetweenNodes, CentresJoinTheSumsWhereNodesAreFew) {
  const Series series = SyntheticSnapshot(grid_with_cells(), opening).series();
  const auto parametrization = make_parametrization("tip", series.geometry);
  const auto bases = bases_of({1, 4, 2, 3, 2, 1, 2}, *parametrization, 8);
  const std::array<BSplineBasis, 3> space{bases[0], bases[1], bases[2]};
  const FrameFit fit(series, *parametrization, space);
  std::vector<Sample> samples = series.samples;
  samples.insert(samples.end(), series.centres.samples.begin(), series.centres.samples.end());
  const SpaceFit all(*parametrization, space, samples);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(fit.ties().size(), fit.ties().size());
  for (const std::size_t j : {1, 7}) {
    Eigen::MatrixX3d data(static_cast<Eigen::Index>(samples.size()), 3);
    data << series.frames[j], series.centres.mean(series.frames[j]);
    const double t = series.times[j];
    const Eigen::MatrixXd sum = fit.space().multiply(fit.normal(j, 0), identity),
                          expected = all.multiply(all.normal(t, 0), identity);
    // But for the identity that is added, 1e-11 of the mean of the diagonal, once for each group.
    EXPECT_LT((sum - expected).norm(), 1e-9 * expected.norm());
    const Eigen::MatrixX3d right = all.project(data, t);
    EXPECT_LT((fit.project(j, series.frames[j]) - right).norm(), 1e-12 * right.norm());
  }
}

/// In the first frames all knots between start and tip lie within a column of cells or two.
TEST(BetweenNodes, EarlyFramesFollowTheElementsThere) {
  const Series series = SyntheticSnapshot(grid_with_cells(), opening).series();
  const Field field = encoded_on(series, "tip", {1, 4, 2, 3, 2, 1, 4}).field;
  const Eigen::MatrixX3d means = series.centres.mean(series.frames[1]);
  double worst = 0;
  for (std::size_t c = 0; c < series.centres.samples.size(); ++c) {
    const auto row = means.row(static_cast<Eigen::Index>(c));
    const Vec3 spline = field.displacement(series.centres.samples[c].uvw, Side::both, series.times[1]);
    worst = std::max(worst, norm(spline - Vec3{row(0), row(1), row(2)}));
  }
  // The fit is as good there as at the nodes of its worst frame.
  EXPECT_LT(worst, field.report.spline_error * series.largest_displacement);
}

/// Of a field that goes astray, at every centroid by the definition: what the distance from the mean is more
/// than half of what the values vary by in a cell of the same nodes.
TEST(BetweenNodes, WhatIsAstrayIsTold) {
  const Series series = SyntheticSnapshot(grid_with_cells(), opening).series();
  Field smooth = encoded_on(series, "tip", {1, 4, 2, 3, 2, 1, 4}).field;
  std::vector<Vec3> points = smooth.coefficients();
  for (std::size_t n = 0; n < points.size(); ++n) points[n] += 0.2 * std::sin(1. * n) * Vec3{1, -2, 0.5};
  Field astray(smooth.shared_parametrization(),
               {smooth.basis(0), smooth.basis(1), smooth.basis(2), smooth.basis(3)}, points);
  const std::vector<BetweenNodes> found = add_between_nodes(astray, series);
  add_between_nodes(smooth, series);
  const Snapshot s = grid_with_cells();
  double most = 0;
  for (std::size_t j = 0; j < series.times.size(); ++j) {
    const auto data = [&](std::int64_t n) {
      const auto row = series.frames[j].row(static_cast<Eigen::Index>(n));
      return Vec3{row(0), row(1), row(2)};
    };
    std::vector<double> varies(s.points.size(), 0);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t c = 0; c < s.cell_types.size(); ++c) {
        Vec3 mean, at;
        double farthest = 0, least = 1e9;
        for (std::size_t k = 8 * c; k < 8 * c + 8; ++k)
          mean += 0.125 * data(s.connectivity[k]), at += 0.125 * s.points[s.connectivity[k]];
        for (std::size_t k = 8 * c; k < 8 * c + 8; ++k) {
          farthest = std::max(farthest, norm(data(s.connectivity[k]) - mean));
          least = std::min(least, varies[s.connectivity[k]]);
        }
        for (std::size_t k = 8 * c; pass == 0 && k < 8 * c + 8; ++k)
          varies[s.connectivity[k]] = std::max(varies[s.connectivity[k]], farthest);
        if (pass == 0) continue;
        const double off = norm(astray.displacement(at, Side::both, series.times[j]) - mean) - 0.5 * least;
        if (off > most) {
          most = off;
          if (std::abs(off - found.front().error) < 1e-12) {
            EXPECT_LT(norm(at - found.front().at), 1e-12);
            EXPECT_EQ(series.times[j], found.front().time);
          }
        }
      }
  }
  EXPECT_NEAR(found.front().error, most, 1e-12);
  EXPECT_GT(astray.report.between_nodes, 0.1);
  EXPECT_EQ(astray.report.between_nodes, found.front().error / series.largest_displacement);
  EXPECT_LT(smooth.report.between_nodes, 0.005);
}

TEST(BetweenNodes, SupportedRungsAreDeterminedByTheNodes) {
  const Series series = SyntheticSnapshot(cut_in(grid(30, 30, 10), eight_times), opening).series();
  for (const char* name : {"tip", "fixed"}) {
    const auto parametrization = make_parametrization(name, series.geometry);
    const std::vector<Rung> ladder = ladder_of(*parametrization);
    const std::vector<Rung> rungs = supported(ladder, series, *parametrization);
    EXPECT_EQ(rungs.front(), ladder.front());
    EXPECT_GE(rungs.size(), 3u) << name;
    EXPECT_NE(rungs.back(), ladder.back()) << name;
    for (std::size_t i = 1; i < rungs.size(); ++i) {
      const auto bases = bases_of(rungs[i], *parametrization, 8);
      if (std::string(name) == "tip") {
        EXPECT_LE(6 * bases[0].size() * bases[1].size() * bases[2].size(),
                  static_cast<int>(series.samples.size()));
      }
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::MatrixXd values =
            Eigen::MatrixXd::Zero(2 * static_cast<int>(series.samples.size()), bases[axis].size());
        int row = 0;
        for (const Sample& sample : series.samples)
          for (const Limit limit : {Limit::from_left, Limit::from_right}) {
            const Vec3& p = sample.uvw;
            const double place = axis == 0   ? parametrization->along(p.x, 8).value
                                 : axis == 1 ? parametrization->across(p.y).value
                                             : parametrization->height(p.z).value;
            const auto b = bases[axis].evaluate(place, limit);
            for (int k = 0; k < 4; ++k) values(row, b.first + k) = b.value[k];
            ++row;
          }
        EXPECT_EQ(values.colPivHouseholderQr().rank(), bases[axis].size()) << name << ' ' << i << ' ' << axis;
      }
    }
  }
}

}  // namespace cleft
