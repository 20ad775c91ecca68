#include "encoder/field/field_source.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

namespace {

constexpr double blended = 0.2;     // of the gap between two breaks, or the sum of the distances from them
constexpr double beyond_joint = 4;  // what distances beyond a joined end count

/// By how far x is outside, with factors for either end.
double overshoot(const Interval& range, double x, bool front_joined, bool back_joined) {
  if (x < range.front) return (front_joined ? beyond_joint : 1) * (range.front - x);
  if (x > range.back) return (back_joined ? beyond_joint : 1) * (x - range.back);
  return 0;
}

double distance_from(const FieldSource& source, const Vec3& x) {
  const Vec3 at = source.canonical(x);
  const BreakExtent extent = source.extent.value_or(BreakExtent{});
  const double along = overshoot(extent.along, at.x, extent.joined[0], extent.joined[1]);
  const bool round = source.map && source.map->round();
  const double height = round ? 0 : overshoot(extent.height, at.z, extent.joined[2], extent.joined[3]);
  return std::sqrt(at.y * at.y + along * along + height * height);
}

/// From 0 at -1 to 1 at 1.
double smooth_step(double s) {
  const double t = std::clamp((s + 1) / 2, 0., 1.);
  return t * t * (3 - 2 * t);
}

}  // namespace

SourceName::SourceName(const std::string& text) : there(text), here(text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return;
  there = text.substr(0, colon), here = text.substr(colon + 1);
  const std::size_t bracket = here.find('[');
  if (bracket == std::string::npos || bracket == 0 || !here.ends_with(']')) return;
  unit = here.substr(bracket + 1, here.size() - bracket - 2), here.resize(bracket);
}

std::string unit_of(const FieldSource& source, const std::string& name) {
  for (const std::string& field : source.fields)
    if (const SourceName one(field); one.here == name) return one.unit;
  return "";
}

std::vector<double> BreakExtent::numbers() const {
  std::vector<double> list = {along.front, along.back, height.front, height.back};
  for (const bool end : joined) list.push_back(end ? 1 : 0);
  list.insert(list.end(), gaps.begin(), gaps.end());
  return list;
}

BreakExtent BreakExtent::from(const std::vector<double>& numbers) {
  const bool good = numbers.size() >= 8 &&
                    std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }) &&
                    numbers[0] <= numbers[1] && numbers[2] <= numbers[3];
  if (!good)
    throw InputError("the extent of a break must be 8 numbers, of which pairs are intervals, and gaps");
  BreakExtent extent{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, {}};
  for (std::size_t i = 0; i < 4; ++i) extent.joined[i] = numbers[4 + i] != 0;
  extent.gaps.assign(numbers.begin() + 8, numbers.end());
  return extent;
}

void piece_weights(std::span<const FieldSource* const> sources, const Vec3& x, std::span<double> out) {
  CLEFT_CHECK(out.size(), ==, sources.size());
  std::vector<double> distance;
  distance.reserve(sources.size());
  for (const FieldSource* source : sources) distance.push_back(distance_from(*source, x));
  const auto gap = [&](std::size_t i, std::size_t j) {
    const auto& extent = sources[i]->extent;
    return extent && j < extent->gaps.size() ? extent->gaps[j] : 0.;
  };
  double sum = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = 1;
    for (std::size_t j = 0; j < out.size() && out[i] > 0; ++j) {
      if (j == i) continue;
      const double width = blended * (gap(i, j) > 0 ? gap(i, j) : distance[i] + distance[j]);
      out[i] *= width > 0 ? smooth_step((distance[j] - distance[i]) / width) : 0.5;
    }
    sum += out[i];
  }
  for (double& weight : out) weight /= sum;
}

std::vector<Vec3> places_inside_cells(const std::vector<Vec3>& points,
                                      const std::vector<std::int64_t>& offsets,
                                      const std::vector<std::int64_t>& connectivity) {
  constexpr double inward = 0.01;  // of the way to the mean of the cells' centroids
  std::vector<Vec3> sum(points.size());
  std::vector<int> count(points.size());
  for (std::size_t c = 0; c + 1 < offsets.size(); ++c) {
    if (offsets[c] == offsets[c + 1]) continue;
    Vec3 centroid;
    for (auto i = offsets[c]; i < offsets[c + 1]; ++i) centroid += points[connectivity[i]];
    centroid *= 1 / static_cast<double>(offsets[c + 1] - offsets[c]);
    for (auto i = offsets[c]; i < offsets[c + 1]; ++i)
      sum[connectivity[i]] += centroid, ++count[connectivity[i]];
  }
  for (std::size_t n = 0; n < points.size(); ++n)
    sum[n] = count[n] == 0 ? points[n] : lerp(points[n], (1. / count[n]) * sum[n], inward);
  return sum;
}

}  // namespace cleft
