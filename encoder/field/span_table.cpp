#include "encoder/field/span_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace cleft {

namespace {

using Shares = std::array<double, 4>;

/// The blossom of the functions that live on [knots[i], knots[i + 1]], at its ends only: `ends` of the p
/// arguments are the back one. Cox - de Boor with another argument at each level; the quotients are exactly 0
/// and 1 where a knot has full multiplicity, so the values are, too.
Shares blossom(const std::vector<double>& knots, int i, int p, int ends) {
  Shares n{1, 0, 0, 0};
  for (int j = 1; j <= p; ++j) {
    const double x = j <= ends ? knots[i + 1] : knots[i];
    double carried = 0;
    for (int r = 0; r < j; ++r) {
      const double width = knots[i + r + 1] - knots[i + 1 - j + r];
      const double value = n[r];
      n[r] = carried + (knots[i + r + 1] - x) / width * value;
      carried = (x - knots[i + 1 - j + r]) / width * value;
    }
    n[j] = carried;
  }
  return n;
}

/// Coefficients of a polynomial of degree p in the Bernstein polynomials of degree p + 1.
void elevate(std::array<Shares, 4>& c, int p) {
  c[p + 1] = c[p];
  for (int m = p; m >= 1; --m)
    for (int r = 0; r < 4; ++r) c[m][r] = (m * c[m - 1][r] + (p + 1 - m) * c[m][r]) / (p + 1);
}

BasisSpan span_of(const BSplineBasis& basis, int i) {
  const int p = basis.degree();
  std::array<Shares, 4> shares{};
  for (int m = 0; m <= p; ++m) shares[m] = blossom(basis.knots(), i, p, m);
  for (int degree = p; degree < 3; ++degree) elevate(shares, degree);
  BasisSpan span{{}, basis.knots()[i], basis.knots()[i + 1] - basis.knots()[i], i - p};
  for (int m = 0; m < 4; ++m) std::copy(shares[m].begin(), shares[m].end(), span.share[m]);
  return span;
}

}  // namespace

SpanTable::SpanTable(const BSplineBasis& basis)
    : front_(basis.front()),
      back_(basis.back()),
      break_(std::numeric_limits<double>::quiet_NaN()),
      size_(basis.size() + std::max(0, 3 - basis.degree())) {
  if (basis.degree() > 3)
    throw InputError("degree " + std::to_string(basis.degree()) + " of a field's basis: must be 1 to 3");
  const auto& knots = basis.knots();
  double narrowest = back_ - front_;
  for (int i = basis.degree(); i < basis.size(); ++i) {
    if (!(knots[i] < knots[i + 1])) continue;
    narrowest = std::min(narrowest, knots[i + 1] - knots[i]);
    spans_.push_back(span_of(basis, i));
    ends_.push_back(knots[i + 1]);
  }
  ends_.back() = std::numeric_limits<double>::infinity();
  // Twice as many buckets as the narrowest span needs: then at most one span ends in most of them.
  const double buckets = std::clamp(2 * std::ceil((back_ - front_) / narrowest), 1., 2048.);
  scale_ = buckets / (back_ - front_);
  last_bucket_ = buckets - 1;
  // bucket_of() never decreases, so a span that ends in an earlier bucket has ended, however numbers round.
  for (int b = 0, span = 0; b < static_cast<int>(buckets); ++b) {
    starts_.push_back(static_cast<std::uint16_t>(span));
    const int before = span;
    while (std::isfinite(ends_[span]) && bucket_of(ends_[span]) <= b) ++span;
    ends_a_bucket_ = std::max(ends_a_bucket_, span - before);
  }
}

double SpanTable::bucket_of(double x) const {
  const double bucket = (x - front_) * scale_;
  return std::floor(bucket > 0 ? std::min(bucket, last_bucket_) : 0);
}

void SpanTable::break_at(double x, const BSplineBasis& basis) {
  if (!(front_ < x && x < back_)) return;
  const int behind = find(x), p = basis.degree();
  const BasisSpan left = spans_[behind - 1], right = spans_[behind];
  if (right.begin != x || right.first != left.first + p + 1) return;
  BasisSpan mean{{}, x, 1, left.first + p - 1};
  for (auto& share : mean.share) share[1] = share[2] = 0.5;
  break_ = x;
  spans_.push_back(mean);
}

int SpanTable::evaluate(double x, double (&value)[4]) const {
  x = std::clamp(x, front_, back_);
  const BasisSpan& span = spans_[find(x)];
  const double s = (x - span.begin) / span.length, r = 1 - s;
  const double b[4] = {r * r * r, 3 * r * r * s, 3 * r * s * s, s * s * s};
  for (int i = 0; i < 4; ++i)
    value[i] =
        b[0] * span.share[0][i] + b[1] * span.share[1][i] + b[2] * span.share[2][i] + b[3] * span.share[3][i];
  return span.first;
}

Axes::Axes(std::array<SpanTable, 4> of_axes) : tables(std::move(of_axes)), break_at(tables[1].break_) {
  for (int a = 0; a < 4; ++a) {
    const SpanTable& table = tables[a];
    front[a] = table.front_, scale[a] = table.scale_, last_bucket[a] = table.last_bucket_;
    spans[a] = table.spans_.data(), ends[a] = table.ends_.data(), starts[a] = table.starts_.data();
    ends_a_bucket = std::max(ends_a_bucket, table.ends_a_bucket_);
  }
  if (std::isnan(break_at)) return;
  const int behind = tables[1].find(break_at);
  at_break = {spans[1] + behind - 1, &tables[1].spans_.back(), spans[1] + behind};
}

}  // namespace cleft
