#include "encoder/interpolate/geometry_model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "encoder/interpolate/least_squares.h"

namespace cleft {

namespace {

constexpr int plain_measures = 11;  // ends of four axes; start, length and depth of the cut

/// Times of a path as parts of its duration.
std::vector<double> parts_of(const FieldGeometry& g) {
  const auto [front, back] = g.domain[3];
  std::vector<double> parts;
  for (const double t : g.tip.times) parts.push_back((t - front) / (back - front));
  return parts;
}

/// Those of all paths, without those that differ by rounding.
std::vector<double> common_times(const std::vector<FieldGeometry>& geometries) {
  std::set<double> all;
  for (const FieldGeometry& g : geometries)
    for (const double part : parts_of(g)) all.insert(part);
  std::vector<double> times;
  for (const double part : all)
    if (times.empty() || part - times.back() > 1e-9) times.push_back(part);
  return times;
}

double unit_of(const FieldGeometry& g) { return g.cut.length > 0 ? g.cut.length : 1; }

Eigen::VectorXd measures_of(const FieldGeometry& g, const std::vector<double>& times) {
  Eigen::VectorXd m(plain_measures + static_cast<Eigen::Index>(times.size()));
  for (int axis = 0; axis < 4; ++axis)
    m[2 * axis] = g.domain[axis].front, m[2 * axis + 1] = g.domain[axis].back;
  m[8] = g.cut.start, m[9] = g.cut.length, m[10] = g.cut.depth;
  const auto [front, back] = g.domain[3];
  for (std::size_t k = 0; k < times.size(); ++k)
    m[plain_measures + static_cast<Eigen::Index>(k)] =
        (g.tip.at(front + times[k] * (back - front)) - g.cut.start) / unit_of(g);
  return m;
}

FieldGeometry geometry_of(const Eigen::VectorXd& m, const std::vector<double>& times) {
  FieldGeometry g;
  for (int axis = 0; axis < 4; ++axis) g.domain[axis] = {m[2 * axis], m[2 * axis + 1]};
  g.cut = {m[8], m[9], m[10]};
  const auto [front, back] = g.domain[3];
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double position = g.cut.start + m[plain_measures + static_cast<Eigen::Index>(k)] * unit_of(g);
    g.tip.times.push_back(k + 1 == times.size() && times[k] == 1 ? back : front + times[k] * (back - front));
    g.tip.positions.push_back(k == 0 ? position : std::max(position, g.tip.positions.back()));
  }
  return g;
}

}  // namespace

GeometryModel::GeometryModel(const std::vector<RecordedParameters>& parameters,
                             const std::vector<FieldGeometry>& geometries)
    : varying_(varying_parameters(parameters)), times_(common_times(geometries)) {
  const auto n = static_cast<Eigen::Index>(parameters.size()), d = static_cast<Eigen::Index>(varying_.size());
  middle_.setZero(d), half_.setOnes(d), places_.resize(n, d);
  for (Eigen::Index i = 0; i < n; ++i) places_.row(i) = place_of(parameters[i]).transpose();
  const Eigen::VectorXd least = places_.colwise().minCoeff(), greatest = places_.colwise().maxCoeff();
  middle_ = 0.5 * (least + greatest), half_ = 0.5 * (greatest - least);
  for (Eigen::Index i = 0; i < n; ++i) places_.row(i) = place_of(parameters[i]).transpose();

  for (Eigen::Index k = 0; k < d; ++k)
    if (!is_prestress(parameters.front(), varying_[static_cast<std::size_t>(k)])) measured_by_.push_back(k);
  Eigen::MatrixXd design(n, std::ssize(measured_by_) + 1),
      measures(n, plain_measures + static_cast<Eigen::Index>(times_.size()));
  design << Eigen::VectorXd::Ones(n), places_(Eigen::all, measured_by_);
  for (Eigen::Index i = 0; i < n; ++i) measures.row(i) = measures_of(geometries[i], times_).transpose();
  linear_ = shortest_least_squares(design, measures);
  left_ = measures - design * linear_;
  constant_ = measures.row(0).transpose();
  for (Eigen::Index k = 0; k < constant_.size(); ++k)
    if ((measures.col(k).array() != constant_[k]).any()) constant_[k] = std::nan("");
}

Eigen::VectorXd GeometryModel::place_of(const RecordedParameters& parameters) const {
  Eigen::VectorXd place(static_cast<Eigen::Index>(varying_.size()));
  for (Eigen::Index k = 0; k < place.size(); ++k)
    place[k] = (parameters.number(varying_[k]).value() - middle_[k]) / half_[k];
  return place;
}

FieldGeometry GeometryModel::at(const RecordedParameters& parameters) const {
  const Eigen::VectorXd place = place_of(parameters);
  Eigen::VectorXd row(std::ssize(measured_by_) + 1);
  row << 1, place(measured_by_);
  const Eigen::ArrayXd squared = (places_.rowwise() - place.transpose()).rowwise().squaredNorm();
  const Eigen::VectorXd near = (squared + 1e-24).inverse().square();
  Eigen::VectorXd measures = linear_.transpose() * row + left_.transpose() * (near / near.sum());
  for (Eigen::Index k = 0; k < measures.size(); ++k)
    if (!std::isnan(constant_[k])) measures[k] = constant_[k];
  return geometry_of(measures, times_);
}

}  // namespace cleft
