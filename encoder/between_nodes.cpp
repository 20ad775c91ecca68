#include "encoder/between_nodes.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "base/parallel.h"
#include "encoder/field/quantity_fields.h"

namespace cleft {

namespace {

constexpr double varied = 0.5;        // of what values vary by, at most by the curvature of a field
constexpr std::size_t most = 100000;  // places of each kind

/// Of each node, the farthest of a value in one of its cells from the cell's mean.
Eigen::VectorXd spread_of(const CellCentres& cells, const Eigen::MatrixXd& values) {
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(values.rows());
  const Eigen::MatrixXd means = cells.mean(values);
  for (std::size_t c = 0; c < cells.samples.size(); ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    double farthest = 0;
    for (std::size_t k = cells.first[c]; k < cells.first[c + 1]; ++k)
      farthest = std::max(farthest, norms_of(values.row(cells.nodes[k]) - means.row(row))(0));
    for (std::size_t k = cells.first[c]; k < cells.first[c + 1]; ++k)
      spread(cells.nodes[k]) = std::max(spread(cells.nodes[k]), farthest);
  }
  return spread;
}

/// Of a field at samples, one a row.
using Evaluate = std::function<Eigen::MatrixXd(const std::vector<Place>&)>;

std::vector<Place> places_at(const CellCentres& centres, double t) {
  std::vector<Place> places;
  places.reserve(centres.samples.size());
  for (const Sample& sample : centres.samples) places.push_back({sample.uvw, sample.side, t});
  return places;
}

Eigen::MatrixXd displacements_at(const Field& field, const std::vector<Place>& places) {
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t n = 0; n < values.size(); ++n)
    rows.row(static_cast<Eigen::Index>(n)) << values[n].x, values[n].y, values[n].z;
  return rows;
}

void add(BetweenNodes& worst, const CellCentres& places, const Evaluate& evaluate,
         const Eigen::MatrixXd& values, const Eigen::VectorXd& spread, double t) {
  if (places.samples.empty()) return;
  const Eigen::VectorXd off = norms_of(evaluate(places_at(places, t)) - places.mean(values));
  for (std::size_t i = 0; i < places.samples.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = places.first[i]; k < places.first[i + 1]; ++k)
      least = std::min(least, spread(places.nodes[k]));
    const double error = off(static_cast<Eigen::Index>(i)) - varied * least;
    if (error > worst.error) worst = {error, places.samples[i].uvw, t};
  }
}

/// At most so many, evenly.
CellCentres some_of(const CellCentres& all) {
  const std::size_t step = all.samples.size() / most + 1;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < all.samples.size(); i += step) some.push_back(i);
  return all.only(some);
}

template <class Frames>
BetweenNodes worst_of(const Frames& frames, const Series& series, const Evaluate& evaluate) {
  const CellCentres centres = some_of(series.centres),
                    middles = series.middles_hold ? some_of(series.middles) : CellCentres{};
  std::vector<BetweenNodes> worst(series.times.size());
  parallel_for(static_cast<int>(worst.size()), [&](int j) {
    const auto frame = static_cast<std::size_t>(j);
    const Eigen::MatrixXd values = frames[frame];
    frames.forget(frame);
    const Eigen::VectorXd spread = spread_of(series.centres, values);
    for (const CellCentres* places : {&centres, &middles})
      add(worst[frame], *places, evaluate, values, spread, series.times[frame]);
  });
  return *std::max_element(worst.begin(), worst.end(),
                           [](const BetweenNodes& a, const BetweenNodes& b) { return a.error < b.error; });
}

}  // namespace

double error_at_centres(const Field& field, const Series& series) {
  const CellCentres centres = some_of(series.centres);
  std::vector<double> errors(series.times.size(), 0.);
  parallel_for(static_cast<int>(errors.size()), [&](int j) {
    if (centres.samples.empty()) return;
    const auto frame = static_cast<std::size_t>(j);
    const Eigen::MatrixXd means = centres.mean(series.frames[frame]);
    series.frames.forget(frame);
    errors[frame] =
        norms_of(displacements_at(field, places_at(centres, series.times[frame])) - means).maxCoeff();
  });
  return *std::max_element(errors.begin(), errors.end());
}

std::vector<BetweenNodes> add_between_nodes(Field& field, const Series& series) {
  std::vector<BetweenNodes> all;
  all.push_back(worst_of(series.frames, series,
                         [&](const std::vector<Place>& places) { return displacements_at(field, places); }));
  if (series.largest_displacement > 0)
    field.report.between_nodes = all.front().error / series.largest_displacement;
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    Quantity& quantity = field.quantities[q];
    const QuantityFields fields(field, q);
    all.push_back(worst_of(series.quantities[q].frames, series, [&](const std::vector<Place>& places) {
      std::vector<double> values(places.size() * fields.components());
      fields.at(places, values);
      return Eigen::MatrixXd(Eigen::Map<const NodeRows>(values.data(),
                                                        static_cast<Eigen::Index>(places.size()),
                                                        static_cast<Eigen::Index>(fields.components())));
    }));
    quantity.between_nodes = all.back().error / (quantity.scale > 0 ? quantity.scale : 1);
  }
  return all;
}

}  // namespace cleft
