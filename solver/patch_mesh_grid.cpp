#include "solver/patch_mesh_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace cleft {

namespace {

/// An edge of 45 degrees gets elements of an eighth: with a half, a quarter and a tenth the opening is 6, 3
/// and 1 % less than with a twentieth.
constexpr double lip_power = 6;
/// From one to the next they grow by this to the size of those next to an upright cut.
constexpr double lip_growth = 1.2;

enum class Cut { before, after, both };  // the side of a range of lines on which the cut is

/// Continues the lines to `to`, by the fewest elements that fit. Their nominal size is `step` at the cut, and
/// `growth` times more from one to the next away from it; all are scaled down alike to fit.
void add_stretch(std::vector<double>& lines, double to, double step, Cut cut = Cut::both, double growth = 1) {
  const double from = lines.back(), length = to - from;
  if (cut == Cut::both) growth = 1;
  std::vector<double> sums = {0};  // 1 + growth + growth^2 + ...
  do sums.push_back(sums.back() * growth + 1);
  while (sums.back() < std::abs(length) / step - 1e-9);
  const std::size_t count = sums.size() - 1;
  for (std::size_t k = 1; k < count; ++k) {
    const double part = cut == Cut::after ? sums[count] - sums[count - k] : sums[k];
    lines.push_back(from + length * part / sums[count]);
  }
  lines.push_back(to);
}

/// Sizes of elements that grow from `lip` to less than `step`, in no more than `room`, in which as much as
/// the last of them remains.
std::vector<double> lip_sizes(double lip, double step, double room) {
  std::vector<double> sizes;
  for (double size = lip, sum = 0; size < step && sum + 2 * size <= room; sum += size, size *= lip_growth)
    sizes.push_back(size);
  return sizes;
}

/// Size of the mesh's cut, which ends beyond its fronts, and how far its nodes are moved.
struct Shape {
  MeshedCut cut;
  double length, depth, half_angle, half_span, arc_rise, tilt, tilt_reach;

  explicit Shape(const Parameters& p)
      : cut(meshed_cut(p)),
        length(cut.length),
        depth(cut.depth),
        half_angle(p.cut.radius > 0 ? length / 2 / p.cut.radius : 0),
        half_span(p.cut.radius > 0 ? p.cut.radius * std::sin(half_angle) : length / 2),
        arc_rise(rise(p.cut.radius, half_angle)),
        tilt(p.cut.tilt * std::numbers::pi / 180),
        tilt_reach(std::min(depth, p.patch.height - depth)) {}

  /// How far an arc has come in v where it has turned by `angle`: r (1 - cos angle).
  static double rise(double radius, double angle) {
    const double s = std::sin(angle / 2);
    return 2 * radius * s * s;
  }

  /// Of elements next to the lips, in the size of those next to an upright cut. The lip over a tilted blade
  /// ends in a thin edge, which the skin bends the more the thinner it is. Not on an arc, whose chords would
  /// be as far from it as such an element is wide.
  double lip_part() const { return half_angle > 0 ? 1 : std::pow(std::cos(tilt), lip_power); }

  /// The tilted plane continues below the cut's bottom and becomes upright over `tilt_reach`.
  double tilt_shift(double below_skin) const {
    const double x = std::clamp(below_skin - depth, 0.0, tilt_reach);
    return std::tan(tilt) * (std::min(below_skin, depth) + x - x * x / (2 * tilt_reach));
  }
};

class GridMaker {
 public:
  explicit GridMaker(const Parameters& p) : p_(p), shape_(p) {}

  PatchGrid grid() {
    add_u_lines();
    add_v_lines();
    add_w_lines();
    set_shifts();
    set_start();
    return std::move(grid_);
  }

 private:
  void add_u_lines() {
    const double end = p_.patch.length / 2, step = shape_.cut.step;
    grid_.fronts = shape_.cut.fronts;
    grid_.along = {-shape_.length / 2};
    if (p_.cut.branch > 0) add_stretch(grid_.along, 0, step);
    add_stretch(grid_.along, shape_.length / 2, step);
    grid_.u = {-end};
    add_stretch(grid_.u, -shape_.half_span, step, Cut::after, p_.mesh.grading);
    grid_.u.pop_back();
    grid_.cut_from = static_cast<int>(grid_.u.size());
    for (const double along : grid_.along) {
      const double r = p_.cut.radius, angle = r > 0 ? along / r : 0;
      if (along == 0 && p_.cut.branch > 0) grid_.branch_u = static_cast<int>(grid_.u.size());
      grid_.u.push_back(r > 0 ? r * std::sin(angle) : along);
      grid_.angle.push_back(angle);
    }
    add_stretch(grid_.u, end, step, Cut::before, p_.mesh.grading);
  }

  /// The elements next to the outermost cuts are reduced by the factor by which moving the nodes stretches
  /// them.
  void add_v_lines() {
    const double half = p_.patch.width / 2, step = p_.mesh.element_size, lip = shape_.lip_part();
    const double first = (1 - p_.cut.count) / 2 * p_.cut.spacing;
    const double last = p_.cut.branch > 0 ? shape_.cut.branch : -first;
    const double tilted = shape_.tilt_shift(p_.patch.height);
    const double most = shape_.arc_rise + std::max(tilted, 0.0), least = std::min(tilted, 0.0);
    const double before = step / (1 + most / (half + first)), after = step / (1 - least / (half - last));
    const int count = static_cast<int>(p_.cut.count);
    grid_.v = {-half};
    for (int n = 0; n < count; ++n) {
      if (n == 0) {
        const std::vector<double> sizes = lip_sizes(lip * before, before, half + first);
        double from = first - std::accumulate(sizes.begin(), sizes.end(), 0.);
        add_stretch(grid_.v, from, before, Cut::after, p_.mesh.grading);
        for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) grid_.v.push_back(from += *size);
        grid_.v.back() = first;
      } else {
        add_stretch(grid_.v, first + n * p_.cut.spacing, lip * step);
      }
      grid_.planes.push_back(static_cast<int>(grid_.v.size()) - 1);
    }
    if (p_.cut.branch > 0) add_stretch(grid_.v, last, lip * step);
    grid_.branch_v = static_cast<int>(grid_.v.size()) - 1;
    for (const double size : lip_sizes(lip * after, after, half - last))
      grid_.v.push_back(grid_.v.back() + size);
    add_stretch(grid_.v, half, after, Cut::before, p_.mesh.grading);
  }

  void add_w_lines() {
    const double step = p_.mesh.element_size, lip = shape_.lip_part();
    grid_.w = {0};
    add_stretch(grid_.w, -shape_.depth, step);
    // The last one above the bottom remains: it is a part of it that the cut ends above its closed nodes.
    const double last = grid_.w[grid_.w.size() - 2];
    if (const std::vector<double> sizes = lip_sizes(lip * step, step, -last); !sizes.empty()) {
      grid_.w = {0};
      for (const double size : sizes) grid_.w.push_back(grid_.w.back() - size);
      add_stretch(grid_.w, last, step);
      grid_.w.push_back(-shape_.depth);
    }
    grid_.bottom = static_cast<int>(grid_.w.size()) - 1;
    add_stretch(grid_.w, -p_.patch.height, step, Cut::before, p_.mesh.grading);
  }

  /// All v lines from the first cut to the last (or the branch's end) move alike, the others ever less toward
  /// the patch's sides.
  void set_shifts() {
    grid_.tilt = shape_.tilt;
    for (std::size_t i = 0; i < grid_.u.size(); ++i) grid_.shift_u.push_back(arc_shift(i));
    for (const double w : grid_.w) grid_.shift_w.push_back(shape_.tilt_shift(-w));
    const double half = p_.patch.width / 2;
    const double first = grid_.v[grid_.planes.front()], last = grid_.v[grid_.branch_v];
    for (const double v : grid_.v)
      grid_.blend.push_back(v < first  ? (half + v) / (half + first)
                            : v > last ? (half - v) / (half - last)
                                       : 1);
  }

  void set_start() {
    const double r = p_.cut.radius, along = -shape_.length / 2 + shape_.cut.fronts.along;
    const double u = r > 0 ? r * std::sin(along / r) : along;
    grid_.start = {u, grid_.v[grid_.planes[0]] + (r > 0 ? Shape::rise(r, along / r) : 0), 0};
  }

  double arc_shift(std::size_t i) const {
    const std::size_t n = i - grid_.cut_from;
    if (n < grid_.angle.size()) return Shape::rise(p_.cut.radius, grid_.angle[n]);
    const double end = p_.patch.length / 2, x = (end - std::abs(grid_.u[i])) / (end - shape_.half_span);
    return shape_.arc_rise * x * x * (3 - 2 * x);
  }

  const Parameters& p_;
  const Shape shape_;
  PatchGrid grid_;
};

}  // namespace

Vec3 PatchGrid::cut_normal(int n) const { return normalized({-std::tan(angle[n]), 1, std::tan(tilt)}); }

PatchGrid halved(PatchGrid grid) {
  for (auto* list :
       {&grid.u, &grid.v, &grid.w, &grid.along, &grid.angle, &grid.shift_u, &grid.shift_w, &grid.blend}) {
    std::vector<double> with_middles = {list->front()};
    for (std::size_t n = 1; n < list->size(); ++n)
      with_middles.insert(with_middles.end(), {((*list)[n - 1] + (*list)[n]) / 2, (*list)[n]});
    *list = std::move(with_middles);
  }
  for (int* line : {&grid.cut_from, &grid.branch_u, &grid.branch_v, &grid.bottom})
    if (*line > 0) *line *= 2;
  for (int& plane : grid.planes) plane *= 2;
  return grid;
}

PatchGrid make_patch_grid(const Parameters& parameters) { return GridMaker(parameters).grid(); }

}  // namespace cleft
