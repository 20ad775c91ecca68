#include "encoder/lips.h"

#include <algorithm>
#include <cmath>

#include "encoder/field/unknowns.h"

namespace cleft {

namespace {

constexpr int sweeps = 200;
constexpr double least_motion = 1e-3;  // of the margin: what a sweep must still move

/// gap = sum of factor * (right control point - left one), over free pairs of them; it is to be at least
/// gap + missing.
struct Bound {
  struct Term {
    int jump;
    double factor;
  };
  std::vector<Term> terms;
  double missing = 0, squares = 0, multiplier = 0;
};

/// The pairs of control points at v = 0 that are unknowns of their own, by i, k, l.
class Jumps {
 public:
  explicit Jumps(const Field& field)
      : field_(field), right_(field.basis(1).evaluate(0, Limit::from_right).first) {
    const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
    const ControlTies ties = ties_of(field.parametrization().name(), bases);
    const int W = bases[2].size();
    for (int i = 0; i < bases[0].size(); ++i)
      for (int k = 0; k < W; ++k) {
        const auto &left = ties.row(i)[(right_ - 1) * W + k], &right = ties.row(i)[right_ * W + k];
        free_.push_back(left.terms == 1 && right.terms == 1 && left.term[0].unknown != right.term[0].unknown);
      }
  }

  /// The opening at (u, 0, w) and t as a sum over free pairs of control points. The first control points in t
  /// remain 0.
  Bound bound(const Vec3& uvw, double t) const {
    const Parametrization& p = field_.parametrization();
    const auto along = field_.basis(0).evaluate(p.along(uvw.x, t).value),
               height = field_.basis(2).evaluate(p.height(uvw.z).value),
               time = field_.basis(3).evaluate(p.time(t).value);
    const int W = field_.basis(2).size(), T = field_.basis(3).size();
    Bound bound;
    for (int i = 0; i <= field_.basis(0).degree(); ++i)
      for (int k = 0; k <= field_.basis(2).degree(); ++k)
        for (int l = 0; l <= field_.basis(3).degree(); ++l) {
          const int place = (along.first + i) * W + height.first + k;
          const double factor = along.value[i] * height.value[k] * time.value[l];
          if (!free_[place] || time.first + l == 0 || factor == 0) continue;
          bound.terms.push_back({place * T + time.first + l, factor});
          bound.squares += factor * factor;
        }
    return bound;
  }

  /// The field with these openings more at its control points, half on either side.
  Field widened(const std::vector<double>& by) const {
    const int V = field_.basis(1).size(), W = field_.basis(2).size(), T = field_.basis(3).size();
    std::vector<Vec3> points = field_.coefficients();
    for (std::size_t jump = 0; jump < by.size(); ++jump) {
      const int place = static_cast<int>(jump) / T, l = static_cast<int>(jump) % T, i = place / W,
                k = place % W;
      const auto at = [&](int j) { return static_cast<std::size_t>(((i * V + j) * W + k) * T + l); };
      points[at(right_ - 1)].y -= by[jump] / 2, points[at(right_)].y += by[jump] / 2;
    }
    Field result(field_.shared_parametrization(),
                 {field_.basis(0), field_.basis(1), field_.basis(2), field_.basis(3)}, std::move(points));
    result.report = field_.report;
    return result;
  }
  std::size_t size() const { return free_.size() * static_cast<std::size_t>(field_.basis(3).size()); }

 private:
  const Field& field_;
  int right_;
  std::vector<bool> free_;
};

}  // namespace

namespace {

/// The violated bounds at released pairs and frames.
std::vector<Bound> bounds_of(const Field& field, const Jumps& jumps, const Series& series, double margin) {
  std::vector<Bound> bounds;
  for (std::size_t j = 1; j < series.times.size(); ++j) {
    for (int p = 0; p < series.released[j]; ++p) {
      const auto [left, right] = series.pairs[p];
      const Vec3& uvw = series.samples[left].uvw;
      const double t = series.times[j],
                   opening =
                       field.displacement(uvw, Side::right, t).y - field.displacement(uvw, Side::left, t).y,
                   of_data = series.frames[j](right, 1) - series.frames[j](left, 1);
      const double missing = std::min(of_data, 0.) + margin - opening;
      if (missing <= 0) continue;
      Bound bound = jumps.bound(uvw, t);
      bound.missing = missing;
      if (bound.squares > 0) bounds.push_back(std::move(bound));
    }
    series.frames.forget(j);
  }
  return bounds;
}

/// Openings at control points that keep all bounds: Hildreth's method, the nearest point of all half-spaces.
/// All factors are positive, so that no bound that is kept is ever lost.
std::vector<double> nearest(std::vector<Bound> bounds, std::size_t jumps, double margin) {
  std::vector<double> by(jumps, 0.);
  double moved = margin;
  for (int sweep = 0; sweep < sweeps && moved > least_motion * margin; ++sweep) {
    moved = 0;
    for (Bound& bound : bounds) {
      double missing = bound.missing;
      for (const auto& [jump, factor] : bound.terms) missing -= factor * by[jump];
      const double step = std::max(missing / bound.squares, -bound.multiplier);
      bound.multiplier += step, moved = std::max(moved, std::abs(step * bound.squares));
      for (const auto& [jump, factor] : bound.terms) by[jump] += step * factor;
    }
  }
  return by;
}

/// Largest error at released pairs, mm: a shift of the lips is nowhere larger.
double error_at_lips(const Field& field, const Series& series) {
  double largest = 0;
  for (std::size_t j = 1; j < series.times.size(); ++j) {
    for (int p = 0; p < series.released[j]; ++p) {
      const auto [left, right] = series.pairs[p];
      for (const auto& [node, side] : {std::pair{left, Side::left}, {right, Side::right}}) {
        const Vec3 d = field.displacement(series.samples[node].uvw, side, series.times[j]);
        const auto data = series.frames[j].row(node);
        largest = std::max(largest, squared_norm(d - Vec3{data[0], data[1], data[2]}));
      }
    }
    series.frames.forget(j);
  }
  return std::sqrt(largest);
}

}  // namespace

Field with_lips_apart(const Field& field, const Series& series, double margin, double most) {
  if (series.pairs.empty() || series.largest_displacement == 0) return field;
  const Jumps jumps(field);
  std::vector<Bound> bounds = bounds_of(field, jumps, series, margin);
  // Next to the tip, control points have little influence on a pair and would have to move far: such pairs
  // are dropped first.
  for (const double least : {0., 0.01, 0.1, 0.5}) {
    std::erase_if(bounds, [&](const Bound& bound) { return bound.squares < least; });
    if (bounds.empty()) break;
    Field apart = jumps.widened(nearest(bounds, jumps.size(), margin));
    if (error_at_lips(apart, series) <= most) return apart;
  }
  return field;
}

}  // namespace cleft
