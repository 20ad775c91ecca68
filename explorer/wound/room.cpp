#include "explorer/wound/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleft {

namespace {

/// Displacements are no more than the room over this: their change adds at most its inverse to the strain.
constexpr double least_room = 4;
/// x - x^3 / (3 * 1.5^2) rises with a slope of 1 from 0, and is 1 with a slope of 0 at 1.5.
constexpr double full_weight = 1.5;
/// The strain that coordinates which are further apart than their vertices may add.
constexpr double most_strain = 0.5;
/// Along the path a displacement rises from nothing to its largest in the cut's length over this.
constexpr double rise_in_length = 4;
/// Inside a bend the field of a straight cut is no guide: displacements fall from this part of the way to the
/// medial axis on, by what agrees best with simulated arcs (tests/truth).
constexpr double free_part = 0.5;
/// In how many equal pieces of the path the room next to it is sampled; of one that grows at each of its
/// steps.
constexpr int room_pieces = 512, room_pieces_of_growing = 128;
/// Samples of the field, for its largest displacements.
constexpr int pieces_across = 16, samples_along = 12, samples_in_time = 3;

}  // namespace

void RoomAlong::even_out() {
  for (std::size_t i = 1; i < s_.size(); ++i) room_[i] = std::min(room_[i], room_[i - 1] + s_[i] - s_[i - 1]);
  for (std::size_t i = s_.size(); i-- > 1;)
    room_[i - 1] = std::min(room_[i - 1], room_[i] + s_[i] - s_[i - 1]);
}

double RoomAlong::at(double s) const {
  if (s_.empty()) return std::numeric_limits<double>::infinity();
  const auto next = static_cast<std::size_t>(std::upper_bound(s_.begin(), s_.end(), s) - s_.begin());
  const std::size_t a = next == 0 ? 0 : next - 1, b = std::min(next, s_.size() - 1);
  return std::min(room_[a] + std::abs(s - s_[a]), room_[b] + std::abs(s - s_[b]));
}

NearestPlace::NearestPlace(std::vector<Vec3> places) : places_(std::move(places)), axis_(places_.size()) {
  sort(0, places_.size());
}

void NearestPlace::sort(std::size_t first, std::size_t last) {
  if (last - first < 2) return;
  Vec3 low = places_[first], high = low;
  for (std::size_t i = first; i < last; ++i)
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], places_[i][k]), high[k] = std::max(high[k], places_[i][k]);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return places_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
  axis_[middle] = axis;
  sort(first, middle), sort(middle + 1, last);
}

double NearestPlace::distance(const Vec3& x, double least) const {
  search(0, places_.size(), x, least);
  return least;
}

void NearestPlace::search(std::size_t first, std::size_t last, const Vec3& x, double& least) const {
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  least = std::min(least, norm(places_[middle] - x));
  const double beyond = x[axis_[middle]] - places_[middle][axis_[middle]];
  if (beyond < least) search(first, middle, x, least);
  if (-beyond < least) search(middle + 1, last, x, least);
}

LargestDisplacement::LargestDisplacement(const VaryingField& field, double length) {
  const Field& shape = field.shape();
  const Interval u = shape.domain(0), across = shape.domain(1);
  const CanonicalCut& cut = shape.cut();
  width_ = std::max(-across.front, across.back);
  const double gone = std::min(length, cut.length);
  largest_.assign(pieces_across + 1, 0);
  for (int i = 0; i <= pieces_across; ++i)
    for (int k = 0; k < samples_along; ++k)
      for (int l = 1; l <= samples_in_time; ++l)
        for (const Side side : {Side::left, Side::right}) {
          const double v = width_ * i / pieces_across * (side == Side::left ? -1 : 1);
          const double at = u.front + (u.back - u.front) * (k + 0.5) / samples_along;
          const Vec3 place{at, std::clamp(v, across.front, across.back), 0};
          largest_[i] = std::max(
              largest_[i], norm(field.displacement(place, side, gone * l / samples_in_time, at - cut.start)));
        }
  for (int i = pieces_across; i-- > 0;) largest_[i] = std::max(largest_[i], largest_[i + 1]);
}

double LargestDisplacement::beside(double v) const {
  if (largest_.empty()) return 0;
  const double at = std::min(v / width_, 1.) * pieces_across;
  const int i = std::min(static_cast<int>(at), pieces_across - 1);
  return largest_[i] + (at - i) * (largest_[i + 1] - largest_[i]);
}

void WoundRoom::follow_path(const Incision& incision) {
  const ScalpelPath& path = incision.path();
  const int pieces = incision.extended_to() > 0 ? room_pieces_of_growing : room_pieces;
  for (const bool right : {false, true}) {
    bends_[right] = {};
    for (int i = 0; i <= pieces; ++i) {
      const double s = path.length() * i / pieces;
      bends_[right].push_back(s, path.room(s, right));
    }
    bends_[right].even_out();
  }
  found_ = incision.surroundings().irregular();
  find_irregular();
}

void WoundRoom::fill(const VaryingField& field, const Incision& incision, double scale) {
  scale_ = scale, cut_length_ = field.shape().cut().length;
  largest_ = LargestDisplacement(field, incision.path().length() * scale);
  find_irregular();
}

/// Those where the coordinates would strain the skin by too much.
void WoundRoom::find_irregular() {
  for (const bool right : {false, true}) {
    std::vector<Vec3> places;
    for (const Surroundings::Irregular& one : found_)
      if (one.times * largest(one.across) * rise_in_length / cut_length_ > most_strain &&
          (one.side == Side::both || (one.side == Side::right) == right))
        places.push_back(one.position);
    irregular_[right] = NearestPlace(std::move(places));
  }
}

/// How far it is to the path's medial axis on one side.
double WoundRoom::bend(const Place& at, bool right) const {
  return bends_[right].at(at.s) - std::abs(at.straight);
}

double WoundRoom::weight(const Place& at) const {
  const double enough = full_weight * least_room * largest(at.across) / scale_;
  if (!(enough > 0)) return 1;  // nothing moves
  double room = enough;
  for (const bool right : {false, true})
    if (at.side == Side::both || (at.side == Side::right) == right)
      room = std::min({room, bend(at, right), irregular_[right].distance(at.position, room)});
  if (room <= 0) return 0;
  const double x = full_weight * room / enough;
  const double in_room = room >= enough ? 1 : x - x * x * x / (3 * full_weight * full_weight);
  const double used = std::abs(at.straight) / (bend(at, at.straight > 0) + std::abs(at.straight));
  const double y = std::clamp((used - free_part) / (1 - free_part), 0., 1.);
  return std::min(in_room, 1 - y * y * (3 - 2 * y));
}

}  // namespace cleft
