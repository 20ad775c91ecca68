#include "encoder/interpolate/field_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cleft {

namespace {

constexpr int sampled_times = 12, along = 30, most_heights = 4;
constexpr int around[] = {-3, -2, -1, 0, 1, 2, 3};  // nodes from the tip and the start
constexpr int across[] = {0, 1, 2, 4, 8, 16};       // from the cut

/// Columns of nodes, from the start of the cut on.
struct Columns {
  double start, spacing;
  Interval ends;
  double near(double u) const {
    return std::clamp(start + spacing * std::round((u - start) / spacing), ends.front, ends.back);
  }
};

std::vector<double> along_at(const Columns& columns, double tip) {
  const auto [front, back] = columns.ends;
  std::vector<double> places;
  for (int i = 0; i < along; ++i) places.push_back(columns.near(front + (back - front) * i / (along - 1)));
  for (const int k : around)
    for (const double end : {columns.start, tip}) places.push_back(columns.near(end + k * columns.spacing));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<double> across_from(double edge, double spacing) {
  std::vector<double> places = {edge};
  for (const int k : across)
    if (k * spacing < std::abs(edge)) places.push_back(std::copysign(k * spacing, edge));
  return places;
}

std::vector<double> heights_of(const FieldGeometry& g, double spacing) {
  const auto [bottom, top] = g.domain[2];
  const double depth = g.cut.depth > 0 ? std::min(g.cut.depth, top - bottom) : top - bottom;
  const int layers = std::clamp(static_cast<int>(depth / spacing), 1, most_heights);
  std::vector<double> places = {bottom};
  for (int k = 0; k <= layers; ++k) places.push_back(top - depth * k / layers);
  return places;
}

}  // namespace

std::vector<Place> sample_places(const FieldGeometry& g, double spacing) {
  const auto [begin, end] = g.domain[3];
  const double first = g.tip.positions.front(), last = g.tip.positions.back();
  const Columns columns{g.cut.start, spacing, g.domain[0]};
  std::vector<Place> places;
  for (int j = 1; j <= sampled_times; ++j) {
    double t = begin + (end - begin) * j / sampled_times;
    // The tip at a column of nodes. The first that opens has one behind it and one ahead.
    if (last > first)
      t = g.tip.passes(std::min(
          columns.near(std::max(first + 2 * spacing, first + (last - first) * j / sampled_times)), last));
    if (!places.empty() && t <= places.back().t) continue;
    for (const double u : along_at(columns, g.tip.at(t)))
      for (const double w : heights_of(g, spacing))
        for (const Side side : {Side::left, Side::right})
          for (const double v :
               across_from(side == Side::left ? g.domain[1].front : g.domain[1].back, spacing))
            places.push_back({{u, v, w}, side, t});
  }
  return places;
}

double node_spacing(const RecordedParameters& p, const FieldGeometry& geometry) {
  if (p.has(p->mesh.element_size)) return p->mesh.element_size;
  const auto [front, back] = geometry.domain[0];
  return (geometry.cut.length > 0 ? geometry.cut.length : back - front) / 24;
}

CommonPlaces places_in_common(const CommonCases& cases) {
  const auto nodes = [](const CommonCase& one) {
    return one.geometry.cut.length / node_spacing(one.parameters, one.geometry);
  };
  const CommonCase& coarsest =
      *std::min_element(cases.cases().begin(), cases.cases().end(),
                        [&](const CommonCase& a, const CommonCase& b) { return nodes(a) < nodes(b); });
  return {coarsest.geometry,
          sample_places(coarsest.geometry, node_spacing(coarsest.parameters, coarsest.geometry))};
}

Eigen::VectorXd sample(const CommonCases& cases, const std::vector<Vec3>& points, const CommonPlaces& at) {
  std::vector<Vec3> values(at.places.size());
  cases.field_of(points, at.body).displacements(at.places, values);
  Eigen::VectorXd column(static_cast<Eigen::Index>(3 * values.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
    for (int c = 0; c < 3; ++c) column[static_cast<Eigen::Index>(3 * k) + c] = values[k][c];
  return column;
}

Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at) {
  std::vector<int> all(static_cast<std::size_t>(cases.size()));
  std::iota(all.begin(), all.end(), 0);
  return sample_cases(cases, at, all);
}

Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at, const std::vector<int>& some) {
  Eigen::MatrixXd samples(static_cast<Eigen::Index>(3 * at.places.size()),
                          static_cast<Eigen::Index>(some.size()));
  for (std::size_t i = 0; i < some.size(); ++i)
    samples.col(static_cast<Eigen::Index>(i)) = sample(cases, cases.points(some[i]), at);
  return samples;
}

Eigen::MatrixXd sample_derivatives(const CommonCases& cases, const CommonPlaces& at) {
  Eigen::MatrixXd samples(static_cast<Eigen::Index>(3 * at.places.size()),
                          static_cast<Eigen::Index>(cases.derivatives().size()));
  for (Eigen::Index d = 0; d < samples.cols(); ++d)
    samples.col(d) = sample(cases, points_of(cases.derivative_points(static_cast<std::size_t>(d))), at);
  return samples;
}

double largest_point(const Eigen::Ref<const Eigen::VectorXd>& column) {
  return Eigen::Map<const Eigen::Matrix3Xd>(column.data(), 3, column.size() / 3).colwise().norm().maxCoeff();
}

double largest_displacement(const Field& field, const std::vector<Place>& places) {
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  double largest = 0;
  for (const Vec3& d : values) largest = std::max(largest, squared_norm(d));
  return std::sqrt(largest);
}

}  // namespace cleft
