#include "explorer/wound/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleft {

namespace {
constexpr int pieces_across = 16, samples_along = 12, samples_in_time = 3;
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
  const double at = std::min(v / width_, 1.) * pieces_across;
  const int i = std::min(static_cast<int>(at), pieces_across - 1);
  return largest_[i] + (at - i) * (largest_[i + 1] - largest_[i]);
}

}  // namespace cleft
