#include "encoder/fitted_nodes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace cleft {

namespace {

/// Cells of an axis: evenly long, or finer towards a place.
class Divided {
 public:
  Divided(double front, double back, int cells) : Divided(front, back, cells, 0, 0) {}
  /// `scale`: about the distance from `centre` up to which cells are as short as there; 0: all are even.
  Divided(double front, double back, int cells, double centre, double scale)
      : centre_(centre), scale_(scale), cells_(cells), front_(along(front)), back_(along(back)) {}

  int cell(double x) const {
    const double part = back_ > front_ ? (along(x) - front_) / (back_ - front_) : 0;
    return std::clamp(static_cast<int>(part * cells_), 0, cells_ - 1);
  }
  int cells() const { return cells_; }

 private:
  double along(double x) const { return scale_ > 0 ? std::asinh((x - centre_) / scale_) : x; }

  double centre_, scale_;
  int cells_;
  double front_, back_;
};

/// The same for all samples of a column along u; as if drawn by lot for others.
std::uint64_t lot_of(const Sample& sample) {
  std::uint64_t hash = sample.side == Side::left ? 1 : sample.side == Side::right ? 3 : 2;
  for (const double x : {sample.uvw.y, sample.uvw.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  return hash;
}

constexpr int each = 2;                                      // samples of a cell
constexpr double along_to_deep = 6;                          // cells along u for each one in height
constexpr double across_to_deep = 3;                         // and across
constexpr double near_break = 1. / 16, near_front = 1. / 8;  // of the extent across, and in height

}  // namespace

std::vector<std::int32_t> fitted_nodes(const Snapshot& snapshot, const std::vector<Sample>& samples,
                                       std::size_t most) {
  if (samples.size() <= most) return {};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 least{infinity, infinity, infinity}, greatest{-infinity, -infinity, -infinity};
  for (const Sample& sample : samples)
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], sample.uvw[axis]);
      greatest[axis] = std::max(greatest[axis], sample.uvw[axis]);
    }
  const bool cut = snapshot.cut_length > 0;
  const Vec3 extent = greatest - least;
  const double deep = std::cbrt(static_cast<double>(most) / each / along_to_deep / across_to_deep);
  const auto count = [&](double ratio) { return std::max(1, static_cast<int>(ratio * deep)); };
  const Divided u(least.x, greatest.x, count(along_to_deep)),
      v(least.y, greatest.y, count(across_to_deep), 0, cut ? near_break * extent.y : 0),
      w(least.z, greatest.z, count(1), -snapshot.cut_depth, cut ? near_front * extent.z : 0);

  struct Drawn {
    std::uint64_t lot = std::numeric_limits<std::uint64_t>::max();
    std::int32_t sample = -1;
    bool operator<(const Drawn& other) const {
      return lot < other.lot || (lot == other.lot && sample < other.sample);
    }
  };
  std::vector<std::array<Drawn, each>> cells(static_cast<std::size_t>(u.cells()) *
                                             static_cast<std::size_t>(v.cells() * w.cells()));
  std::vector<char> chosen(samples.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& at = samples[i].uvw;
    if (cut && at.y == 0) chosen[i] = 1;
    const int cell = (u.cell(at.x) * v.cells() + v.cell(at.y)) * w.cells() + w.cell(at.z);
    auto& drawn = cells[static_cast<std::size_t>(cell)];
    const Drawn one{lot_of(samples[i]), static_cast<std::int32_t>(i)};
    if (!(one < drawn.back())) continue;
    drawn.back() = one;
    std::sort(drawn.begin(), drawn.end());
  }
  for (std::size_t c = 0; cut && c + 1 < snapshot.cell_offsets.size(); ++c) {
    const std::span cell(snapshot.connectivity.begin() + snapshot.cell_offsets[c],
                         snapshot.connectivity.begin() + snapshot.cell_offsets[c + 1]);
    if (std::any_of(cell.begin(), cell.end(), [&](std::int64_t n) { return samples[n].uvw.y == 0; }))
      for (const std::int64_t n : cell) chosen[n] = 1;
  }
  for (const auto& drawn : cells)
    for (const Drawn& one : drawn)
      if (one.sample >= 0) chosen[one.sample] = 1;
  std::vector<std::int32_t> list;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) list.push_back(static_cast<std::int32_t>(i));
  return list;
}

}  // namespace cleft
