#include "explorer/wound/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cleft {

namespace {

/// Displacements are no more than the room over this: their change adds at most its inverse to the strain. Of
/// a family: what is left of a jump is its error.
constexpr double least_room = 4, least_room_of_family = 1.5;
/// x - x^3 / (3 * 1.5^2) rises with a slope of 1 from 0, and is 1 with a slope of 0 at 1.5.
constexpr double full_weight = 1.5;
/// The strain that coordinates which are further apart than their vertices may add.
constexpr double most_strain = 0.5;
/// Along the path a displacement rises from nothing to its largest in the cut's length over this.
constexpr double rise_in_length = 4;
/// Of the canonical cut's length: shorter cuts open in proportion to their length, as cracks do; what the
/// field's fit leaves there is its error.
constexpr double resolved_part = 0.1;
/// Inside a bend the field of a straight cut is no guide: displacements fall from this part of the way to the
/// medial axis on, by what agrees best with simulated arcs (tests/truth).
constexpr double free_part = 0.5;
/// In how many equal pieces of the path the room next to it is sampled; of one that grows at each of its
/// steps.
constexpr int room_pieces = 512, room_pieces_of_growing = 128;
/// Samples of the field, for its largest displacements.
constexpr int nodes_along = 33, nodes_across = 33, samples_in_cut = 8;

}  // namespace

CanonicalPlace canonical_place(double s, double length, const CanonicalCut& cut, double opens_on) {
  if (opens_on > 0 && s < opens_on) return {cut.start + opens_on, opens_on - s};
  if (length <= cut.length || s < cut.length / 2) return {cut.start + s, 0};
  if (length - s < cut.length / 2) return {cut.start + cut.length - (length - s), cut.length - length};
  return {cut.start + cut.length / 2, cut.length / 2 - s};
}

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
  const CanonicalCut& cut = shape.cut();
  const double gone = std::min(length, cut.length);
  u_ = shape.domain(0), v_ = shape.domain(1);
  std::vector<double> samples(nodes_along * nodes_across);
  in_time_.resize(samples.size());
  const auto sample = [&](double u, int j) {
    const double v = v_.front + (v_.back - v_.front) * j / (nodes_across - 1);
    const auto i = static_cast<int>(std::lround((u - u_.front) / (u_.back - u_.front) * (nodes_along - 1)));
    double& largest = samples[i * nodes_across + j];
    std::array<InTime, 2> sides{};
    for (int l = 0; l < samples_in_time; ++l)
      for (const Side side : {Side::left, Side::right}) {
        if ((v < 0 && side == Side::right) || (v > 0 && side == Side::left)) continue;
        const double t = gone * (l + 1) / samples_in_time;
        Vec3& d = sides[side == Side::right][l];
        d = field.displacement({u, v, 0}, side, t, u - cut.start);
        largest = std::max(largest, norm(d));
      }
    return sides;
  };
  for (int j = 0; j < nodes_across; ++j) {
    for (int i = 0; i < nodes_along; ++i)
      in_time_[i * nodes_across + j] = sample(u_.front + (u_.back - u_.front) * i / (nodes_along - 1), j);
    for (int k = 0; k < samples_in_cut; ++k) sample(cut.start + gone * (k + 0.5) / samples_in_cut, j);
  }
  // Between samples it may be more: each takes the largest next to it.
  largest_.resize(samples.size());
  for (int i = 0; i < nodes_along; ++i)
    for (int j = 0; j < nodes_across; ++j)
      for (int k = std::max(i - 1, 0); k <= std::min(i + 1, nodes_along - 1); ++k)
        for (int l = std::max(j - 1, 0); l <= std::min(j + 1, nodes_across - 1); ++l)
          largest_[i * nodes_across + j] =
              std::max(largest_[i * nodes_across + j], samples[k * nodes_across + l]);
}

template <class Value, class Sample>
Value LargestDisplacement::between(double u, double v, const Sample& sample) const {
  const auto place = [](double x, const Interval& in, int nodes) {
    return std::clamp((x - in.front) / (in.back - in.front), 0., 1.) * (nodes - 1);
  };
  const double x = place(u, u_, nodes_along), y = place(v, v_, nodes_across);
  const int i = std::min(static_cast<int>(x), nodes_along - 2),
            j = std::min(static_cast<int>(y), nodes_across - 2), at = i * nodes_across + j;
  const Value low = sample(at) + (y - j) * (sample(at + 1) - sample(at)),
              high = sample(at + nodes_across) +
                     (y - j) * (sample(at + nodes_across + 1) - sample(at + nodes_across));
  return low + (x - i) * (high - low);
}

double LargestDisplacement::at(double u, double v) const {
  if (largest_.empty()) return 0;
  return between<double>(u, v, [&](int node) { return largest_[node]; });
}

LargestDisplacement::InTime LargestDisplacement::in_time(double u, double v) const {
  InTime d{};
  for (int l = 0; l < samples_in_time && !in_time_.empty(); ++l)
    d[l] = between<Vec3>(u, v, [&](int node) { return in_time_[node][v > 0][l]; });
  return d;
}

double LargestDisplacement::anywhere() const {
  return largest_.empty() ? 0 : *std::max_element(largest_.begin(), largest_.end());
}

WoundRoom::WoundRoom(const Incision& incision, const VaryingField& field, double scale)
    : largest_(field, incision.path().length() * scale),
      scale_(scale),
      length_(incision.path().length() * scale),
      cut_(field.shape().cut()),
      family_(field.follows_shape()) {
  const double largest = largest_.anywhere(), resolved = resolved_part * cut_.length;
  if (length_ < resolved && largest > 0)
    short_cut_ = std::min(1., length_ / resolved * LargestDisplacement(field, resolved).anywhere() / largest);
  follow_path(incision);
}

void WoundRoom::follow_path(const Incision& incision) {
  if (!family_) find_bends(incision);
  find_jumps(incision);
  find_ends(incision);
}

void WoundRoom::find_bends(const Incision& incision) {
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
}

/// Where the coordinates would strain the skin by too much.
void WoundRoom::find_jumps(const Incision& incision) {
  std::array<std::vector<Vec3>, 2> places;
  for (const Surroundings::Irregular& one : incision.surroundings().irregular()) {
    if (strain(one, incision.path()) <= most_strain) continue;
    for (const bool right : {false, true})
      if (one.side == Side::both || (one.side == Side::right) == right) places[right].push_back(one.position);
  }
  for (const bool right : {false, true}) irregular_[right] = NearestPlace(std::move(places[right]));
}

/// Of a path that grows, its start: what is ahead of it changes with each of its steps.
void WoundRoom::find_ends(const Incision& incision) {
  const ScalpelPath& path = incision.path();
  const auto& stations = incision.surroundings().stations();
  ends_.clear();
  for (const bool last : {false, true}) {
    if (last && incision.extended_to() > 0) continue;
    const double s = last ? path.length() : 0;
    const PathFrame frame = path.at(s);
    const double height = stations.empty() ? 0 : (last ? stations.back() : stations.front()).height;
    End end{frame.position + height * frame.outward, std::numeric_limits<double>::infinity()};
    for (const bool right : {false, true})
      end.room =
          std::min({end.room, bends_[right].at(s), irregular_[right].distance(end.position, end.room)});
    ends_.push_back(end);
  }
}

/// Of the field, mm.
double WoundRoom::largest(double s, double across) const {
  return largest_.at(canonical_place(s * scale_, length_, cut_).u, across * scale_);
}

/// By which coordinates that are further apart than their vertices may strain the skin between these: as a
/// straight cut's displacement changes along it; of a family, whose field is that of this path, by no more
/// than what its displacements at both are apart.
double WoundRoom::strain(const Surroundings::Irregular& at, const ScalpelPath& path) const {
  const double of_straight = at.times * largest(at.s, at.across) * rise_in_length / cut_.length;
  if (!family_ || of_straight <= most_strain) return of_straight;
  const auto in_space = [&](double s, double across) {
    const PathFrame frame = path.at(s);
    auto d = largest_.in_time(canonical_place(s * scale_, length_, cut_).u, across * scale_);
    for (Vec3& one : d) one = one.x * frame.along + one.y * frame.across + one.z * frame.outward;
    return d;
  };
  const auto here = in_space(at.steady, at.across),
             there = in_space(at.neighbour.steady, at.neighbour.across);
  double apart = 0;
  for (std::size_t l = 0; l < here.size(); ++l) apart = std::max(apart, norm(there[l] - here[l]));
  return std::min(of_straight, apart / (scale_ * at.neighbour.distance));
}

/// How far it is to the path's medial axis on one side.
double WoundRoom::bend(const Place& at, bool right) const {
  return bends_[right].at(at.s) - std::abs(at.straight);
}

double WoundRoom::weight(const Place& at) const {
  const double enough =
      full_weight * (family_ ? least_room_of_family : least_room) * largest(at.s, at.across) / scale_;
  if (!(enough > 0)) return 1;  // nothing moves
  double room = enough;
  for (const bool right : {false, true})
    if (at.side == Side::both || (at.side == Side::right) == right)
      room = std::min({room, bend(at, right), irregular_[right].distance(at.position, room)});
  for (const End& end : ends_) room = std::min(room, end.room + norm(at.position - end.position));
  if (room <= 0) return 0;
  const double x = full_weight * room / enough;
  const double in_room = room >= enough ? 1 : x - x * x * x / (3 * full_weight * full_weight);
  const double used = std::abs(at.straight) / (bend(at, at.straight > 0) + std::abs(at.straight));
  const double y = std::clamp((used - free_part) / (1 - free_part), 0., 1.);
  return std::min(in_room, 1 - y * y * (3 - 2 * y));
}

}  // namespace cleft
