#include "encoder/field/blended_field.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

BlendedField::BlendedField(std::vector<Field> pieces) : pieces_(std::move(pieces)) {
  for (const Field& piece : pieces_) {
    bool same = piece.quantities.size() == first().quantities.size();
    for (std::size_t q = 0; same && q < piece.quantities.size(); ++q)
      same = piece.quantities[q].name == first().quantities[q].name &&
             piece.quantities[q].components == first().quantities[q].components;
    if (!piece.source || !piece.source->extent || !same)
      throw InputError("the pieces of the field do not say where their breaks are, or differ in quantities");
    sources_.push_back(&*piece.source);
    to_first_.push_back(axes_between(piece.source->axes, first().source->axes));
  }
}

Vec3 BlendedField::in_source(const Vec3& uvw) const {
  const auto& [u, v, w] = sources_[0]->axes;
  return sources_[0]->origin + uvw.x * u + uvw.y * v + uvw.z * w;
}

Place BlendedField::place(std::size_t piece, const Vec3& in_source, Side side, double t) const {
  const Interval& across = pieces_[piece].domain(1);
  Place place{sources_[piece]->canonical(in_source), side, t};
  if (std::abs(place.uvw.y) <= 1e-9 * (across.back - across.front))
    place.uvw.y = 0;
  else
    place.side = side_of(place.uvw.y);
  return place;
}

bool BlendedField::is_inside(const Vec3& uvw) const {
  const Vec3 x = in_source(uvw);
  std::vector<double> parts(pieces_.size());
  weights(x, parts);
  const auto most = static_cast<std::size_t>(std::max_element(parts.begin(), parts.end()) - parts.begin());
  const Field& field = pieces_[most];
  const Vec3 at = sources_[most]->canonical(x);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [front, back] = field.domain(axis);
    const double slack = 1e-6 * (back - front);
    if (!(at[axis] >= front - slack && at[axis] <= back + slack)) return false;
  }
  return true;
}

template <class Add>
void BlendedField::add_up(const Vec3& uvw, Side side, double t, const Add& add) const {
  const Vec3 x = in_source(uvw);
  std::vector<double> parts(pieces_.size());
  weights(x, parts);
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (parts[p] > 0) add(p, parts[p], place(p, x, side, t));
}

Vec3 BlendedField::displacement(const Vec3& uvw, Side side, double t) const {
  Vec3 sum;
  add_up(uvw, side, t, [&](std::size_t p, double weight, const Place& at) {
    sum += weight * turned(pieces_[p].displacement(at.uvw, at.side, t), to_first_[p]);
  });
  return sum;
}

void BlendedField::quantity(std::size_t index, const Vec3& uvw, Side side, double t,
                            std::span<double> out) const {
  std::fill(out.begin(), out.end(), 0);
  std::vector<double> values(out.size());
  add_up(uvw, side, t, [&](std::size_t p, double weight, const Place& at) {
    pieces_[p].quantity(index, at.uvw, at.side, t, values);
    turn_from(p, pieces_[p].quantities[index].components, values);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] += weight * values[c];
  });
}

FitReport report_of(const std::vector<Field>& pieces) {
  FitReport all = pieces.front().report;
  for (const Field& piece : pieces) {
    const FitReport& one = piece.report;
    for (double FitReport::*error :
         {&FitReport::relative_l2, &FitReport::node_error, &FitReport::between_nodes, &FitReport::gape_error,
          &FitReport::false_gap, &FitReport::frame_error, &FitReport::condition, &FitReport::crease,
          &FitReport::overlap})
      all.*error = std::max(all.*error, one.*error);
    if (one.spline_error > all.spline_error)
      all.spline_error = one.spline_error, all.worst_node = one.worst_node, all.worst_time = one.worst_time;
    all.least_volume = std::min(all.least_volume, one.least_volume);
  }
  return all;
}

}  // namespace cleft
