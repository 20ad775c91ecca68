// Histories: exact where the parametrisation does not move, else fitted piece by piece.
#include <algorithm>
#include <array>
#include <cmath>

#include "encoder/field/field.h"

namespace cleft {

namespace {

using Piece = std::array<Vec3, 4>;

Vec3 value(const Piece& c, double s) {
  const double r = 1 - s;
  return r * r * r * c[0] + 3 * r * r * s * c[1] + 3 * r * s * s * c[2] + s * s * s * c[3];
}

/// One point's displacement over t: a net of control points over along and time.
struct Net {
  const Parametrization& parametrization;
  const SpanTable &along, &time;
  double u;
  const double* points;  // [along][time], 4 doubles each

  Vec3 at(double t) const {
    const Parametrization::Moving place = parametrization.moving(u, t);
    double a[4], b[4];
    const int i = along.evaluate(place.along, a), l = time.evaluate(place.time, b);
    Vec3 sum;
    for (int r = 0; r < 4; ++r) {
      const double* c = points + 4 * (static_cast<std::ptrdiff_t>(i + r) * time.size() + l);
      Vec3 row;
      for (int m = 0; m < 4; ++m, c += 4) row += b[m] * Vec3{c[0], c[1], c[2]};
      sum += a[r] * row;
    }
    return sum;
  }
};

/// The cubic through four values, of which the inner ones are where its error to a quartic is least among all
/// cubics that keep the ends: s = (1 -+ (sqrt(2) - 1)) / 2. Its error there is h^4 f'''' / 2237.
/// `first` is the value at `from`.
Piece through(const Net& net, const Vec3& first, double from, double to) {
  constexpr double q = 0.41421356237309504880 / 2;
  const double h = to - from, middle = from + h / 2;
  const Vec3 a = first, b = net.at(middle - q * h), c = net.at(middle + q * h), d = net.at(to);
  // Halves of the sum and the difference of the inner controls follow from those of the inner values.
  const double s = 0.5 - q, r = 0.5 + q, even = 3 * r * s, odd = 3 * r * s * (r - s);
  const Vec3 sum = (1 / even) * (0.5 * (b + c) - (r * r * r + s * s * s) * (0.5 * (a + d))),
             difference = (1 / odd) * (0.5 * (b - c) - (r * r * r - s * s * s) * (0.5 * (a - d)));
  return {a, sum + difference, sum - difference, d};
}

/// Largest error at points between. Extrema of a quartic's come first: a piece that fails there is not looked
/// at any further.
double error_of(const Piece& piece, const Net& net, double from, double to, double aim) {
  double error = 0;
  for (const double s : {0.5, 0.117, 0.883, 0.03, 0.21, 0.3, 0.4, 0.6, 0.7, 0.79, 0.97}) {
    error = std::max(error, norm(value(piece, s) - net.at(from + s * (to - from))));
    if (error > aim && s == 0.883) break;
  }
  return error;
}

/// Pieces of one point's history: some ten to a hundred serve fields that were fitted to data. One that needs
/// more is no sound field; the rest of its history is then one piece, and its error is in History::error.
constexpr std::size_t most_pieces = 4096;

/// Pieces from one break to another, each as long as it may be: the error goes with the length to the fourth.
void fit(const Net& net, double from, const double to, double tolerance, History& out) {
  const double aim = 0.6 * tolerance;  // between the sampled points, next to knots, it may be larger
  const double shortest = 1e-14 * std::max(std::abs(from), std::abs(to));
  double length = to - from;
  Vec3 first = from < to ? net.at(from) : Vec3{};
  while (from < to) {
    const double left = to - from, pieces = std::ceil(left / length);
    double end = pieces <= 1 ? to : from + left / std::min(pieces, std::max(2., left / length));
    while (true) {
      const double h = end - from;
      const Piece piece = through(net, first, from, end);
      const double error = error_of(piece, net, from, end, aim);
      const double next = error > 0 ? h * std::clamp(0.95 * std::pow(aim / error, 0.25), 0.1, 4.) : 4 * h;
      const bool too_many = out.controls.size() >= most_pieces;
      if (error <= aim || h <= shortest || (too_many && end == to)) {
        out.error = std::max(out.error, error);
        out.breaks.push_back(from);
        out.controls.push_back(piece);
        from = end, first = piece[3];
        length = std::max(next, shortest);
        break;
      }
      if (too_many) {
        end = to;
        continue;
      }
      end = from + std::max(std::min(next, 0.8 * h), shortest);
      // A kink of the tip's way is the better end, should it be that which is in the way.
      const auto& kinks = net.parametrization.geometry().tip.times;
      const auto kink = std::lower_bound(kinks.begin(), kinks.end(), from + h - shortest);
      if (kink != kinks.begin() && kink[-1] > from + shortest) end = std::max(end, kink[-1]);
    }
  }
}

/// The last time, to the bit, at which a point at u is not yet behind the tip: `passes` but for rounding, by
/// bisection, since a slow tip's rounding in u is many steps of t.
double last_not_beyond(const TipPath& tip, double u, double passes) {
  constexpr int steps = 8;  // of rounding, as a tip has them that goes at its usual speed
  for (int i = 0; i < steps && passes > 0 && tip.at(passes) > u; ++i) passes = std::nextafter(passes, 0);
  if (!(passes > 0) || tip.at(passes) <= u) return passes;
  double before = 0, beyond = passes;
  if (tip.at(before) > u) return before;
  while (true) {
    const double middle = before + (beyond - before) / 2;
    if (middle <= before || middle >= beyond) return before;
    (tip.at(middle) > u ? beyond : before) = middle;
  }
}

}  // namespace

std::vector<double> Field::knot_times() const {
  const auto [front, back] = domain(3);
  std::vector<double> times{front};
  for (int i = 1; i < (*axes_)[3].span_count(); ++i)
    if (const double t = parametrization_->time_at((*axes_)[3].spans()[i].begin); front < t && t < back)
      times.push_back(t);
  times.push_back(back);
  return times;
}

void Field::contract(const Vec3& uvw, Side side, double tolerance, History& out) const {
  contract(uvw, side, tolerance, {}, out);
}

void Field::contract(const Vec3& uvw, Side side, double tolerance, std::span<const double> stops,
                     History& out, double until) const {
  out.breaks.clear(), out.controls.clear(), out.error = 0;
  const Parametrization& p = *parametrization_;
  const BasisPlace place = mapped(uvw, side, domain(3).front);
  const double back = std::min(domain(3).back, until);
  if (p.moves_at(p.inside(uvw.x, 0)))
    contract_moving(uvw, place, back, std::max(tolerance, 1e-12 * largest_coefficient_), stops, out);
  else
    contract_fixed(place, back, stops, out);
  out.breaks.push_back(back);
}

/// One coefficient for each function of time, and from them the Bezier controls of each span.
void Field::contract_fixed(const BasisPlace& place, double until, std::span<const double> stops,
                           History& out) const {
  Stencil s;
  kernels_->locate(*axes_, place, s);
  Rows rows;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        rows.row[rows.count] = grid_.data() + (s.first[0] + i) * grid_.stride[0] +
                               (s.first[1] + j) * grid_.stride[1] + (s.first[2] + k) * grid_.stride[2];
        rows.weight[rows.count++] = s.weight[0][i] * s.weight[1][j] * s.weight[2][k];
      }
  out.scratch.resize(grid_.stride[2]);
  kernels_->combine(rows, grid_.stride[2], out.scratch.data());

  const double front = domain(3).front;
  const SpanTable& axis = (*axes_)[3];
  auto stop = stops.begin();
  for (int i = 0; i < axis.span_count(); ++i) {
    const BasisSpan& span = axis.spans()[i];
    Piece piece;
    for (int m = 0; m < 4; ++m) {
      const double* c = &out.scratch[4 * span.first];
      piece[m] = {};
      for (int r = 0; r < 4; ++r, c += 4) piece[m] += span.share[m][r] * Vec3{c[0], c[1], c[2]};
    }
    const double begin = parametrization_->time_at(span.begin),
                 end = i + 1 < axis.span_count() ? parametrization_->time_at(axis.spans()[i + 1].begin)
                                                 : parametrization_->time_at(bases_[3].back()),
                 last = std::min(end, until);
    for (double from = std::max(begin, front); from < last;) {
      while (stop != stops.end() && *stop <= from) ++stop;
      const double to = stop != stops.end() && *stop < last ? *stop : last;
      out.breaks.push_back(from);
      out.controls.push_back(
          part_of_piece(piece, (from - begin) / (end - begin), to == end ? 1 : (to - begin) / (end - begin)));
      from = to;
    }
  }
}

void Field::contract_moving(const Vec3& uvw, const BasisPlace& place, double until, double tolerance,
                            std::span<const double> stops, History& out) const {
  Stencil s;
  kernels_->locate(*axes_, place, s);
  Rows rows;
  rows.count = 16;
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
      rows.row[4 * j + k] =
          grid_.data() + (s.first[1] + j) * grid_.stride[1] + (s.first[2] + k) * grid_.stride[2];
      rows.weight[4 * j + k] = s.weight[1][j] * s.weight[2][k];
    }
  const auto row = static_cast<std::size_t>(grid_.stride[2]),
             along = static_cast<std::size_t>((*axes_)[0].size());
  out.scratch.resize(along * row);
  for (std::size_t i = 0; i < along; ++i) {
    kernels_->combine(rows, grid_.stride[2], &out.scratch[i * row]);
    for (int r = 0; r < rows.count; ++r) rows.row[r] += grid_.stride[0];
  }
  const Parametrization& p = *parametrization_;
  const TipPath& tip = p.geometry().tip;
  const double u = p.inside(uvw.x, 0);
  double passes = tip.passes(u);
  if (passes <= domain(3).back) passes = last_not_beyond(tip, u, passes);
  const Net net{p, (*axes_)[0], (*axes_)[3], u, out.scratch.data()};
  auto stop = stops.begin();
  for (double from = domain(3).front; from < until;) {
    while (stop != stops.end() && *stop <= from) ++stop;
    double to = stop != stops.end() && *stop < until ? *stop : until;
    if (from < passes && passes < to) to = passes;
    fit(net, from, to, tolerance, out);
    from = to;
  }
}

}  // namespace cleft
