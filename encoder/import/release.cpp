#include "encoder/import/release.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace cleft {

namespace {

class Opening {
 public:
  Opening(const Snapshot& s, const Break& found, const BeyondArm& beyond)
      : s_(s),
        found_(found),
        beyond_(beyond),
        never_(static_cast<int>(s.frames())),
        rounding_(2e-5 * diagonal(s.points)) {
    for (std::size_t p = 0; p < found.pairs.size(); ++p) {
      const Vec3& x = place(p);
      low_ = {std::min(low_.x, x.x), 0, std::min(low_.z, x.z)};
      high_ = {std::max(high_.x, x.x), 0, std::max(high_.z, x.z)};
    }
  }

  const Vec3& place(std::size_t pair) const { return s_.points[found_.pairs[pair][0]]; }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

  std::vector<std::size_t> order() const {
    std::vector<std::size_t> order(found_.pairs.size());
    std::iota(order.begin(), order.end(), 0);
    const std::vector<int> column = columns(order);
    const auto rank = [&](std::size_t p) {
      return std::tuple(found_.first_frame[p], column[p], -place(p).z, p);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return rank(i) < rank(k); });
    return order;
  }

  /// Frame 0 counts as closed.
  std::vector<std::int32_t> released() const {
    std::vector<std::int32_t> count(s_.frames());
    for (std::size_t j = 1; j < count.size(); ++j)
      count[j] =
          static_cast<std::int32_t>(std::count_if(found_.first_frame.begin(), found_.first_frame.end(),
                                                  [&](int first) { return first <= static_cast<int>(j); }));
    return count;
  }

  std::vector<double> position() const {
    if (found_.pairs.empty()) return std::vector<double>(s_.frames());
    if (opens_at_once()) return std::vector<double>(s_.frames(), high_.x);
    const std::vector<double> whole = beyond_.ends_at_others ? std::vector<double>() : undivided_ahead();
    double end = high_.x;
    if (beyond_.ends_at_others)
      for (const Vec3& at : s_.points) end = std::max(end, at.x);
    for (const double u : beyond_.u) end = std::max(end, u);
    std::vector<double> position;
    for (int j = 0; j < never_; ++j) {
      double front = -std::numeric_limits<double>::infinity(), next = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < found_.pairs.size(); ++p)
        if (j > 0 && found_.first_frame[p] <= j) front = std::max(front, place(p).x);
      for (std::size_t p = 0; p < beyond_.u.size(); ++p)
        if (j > 0 && beyond_.first_frame[p] <= j) front = std::max(front, beyond_.u[p]);
      const auto see = [&](double u) {
        if (u > front + rounding_) next = std::min(next, u);
      };
      for (std::size_t p = 0; p < found_.pairs.size(); ++p)
        if (j == 0 || found_.first_frame[p] > j) see(place(p).x);
      for (std::size_t p = 0; p < beyond_.u.size(); ++p)
        if (j == 0 || beyond_.first_frame[p] > j) see(beyond_.u[p]);
      if (front > -std::numeric_limits<double>::infinity()) std::for_each(whole.begin(), whole.end(), see);
      position.push_back(std::isfinite(next) ? next : end);
    }
    return position;
  }

 private:
  /// Pairs at the same u, up to rounding, are one column; columns count along u.
  std::vector<int> columns(std::vector<std::size_t> along) const {
    std::sort(along.begin(), along.end(),
              [this](std::size_t i, std::size_t k) { return place(i).x < place(k).x; });
    std::vector<int> column(along.size());
    for (std::size_t i = 1; i < along.size(); ++i)
      column[along[i]] =
          column[along[i - 1]] + (place(along[i]).x - place(along[i - 1]).x > rounding_ ? 1 : 0);
    return column;
  }

  bool opens_at_once() const {
    int first = never_;
    for (const int f : found_.first_frame) first = std::min(first, std::max(f, 1));
    return first < never_ && std::all_of(found_.first_frame.begin(), found_.first_frame.end(),
                                         [&](int f) { return std::max(f, 1) == first || f == never_; });
  }

  /// Places of nodes in the plane that are one, at the depth of the pairs: where the cut's end has stopped.
  std::vector<double> undivided_ahead() const {
    std::vector<char> paired(s_.points.size());
    for (const auto& [left, right] : found_.pairs) paired[left] = paired[right] = 1;
    std::vector<double> places;
    for (std::size_t i = 0; i < s_.points.size(); ++i)
      if (const Vec3& x = s_.points[i]; !paired[i] && x.y == 0 && low_.z - rounding_ <= x.z &&
                                        x.z <= high_.z + rounding_ && x.x > high_.x + rounding_)
        places.push_back(x.x);
    return places;
  }

  const Snapshot& s_;
  const Break& found_;
  const BeyondArm& beyond_;
  int never_;
  double rounding_;
  Vec3 low_{std::numeric_limits<double>::infinity(), 0, std::numeric_limits<double>::infinity()},
      high_ = -low_;
};

}  // namespace

void fill_cut(Snapshot& s, const Break& found, const BeyondArm& beyond) {
  const Opening opening(s, found, beyond);
  s.released = opening.released();
  s.position = opening.position();
  for (const std::size_t p : opening.order()) s.pairs.push_back(found.pairs[p]);
  if (s.pairs.empty()) return;
  s.cut_start = opening.low().x;
  s.cut_length = opening.high().x - opening.low().x;
  s.cut_depth = opening.high().z - opening.low().z;
}

}  // namespace cleft
