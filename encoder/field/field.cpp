#include "encoder/field/field.h"

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace cleft {

namespace {

std::shared_ptr<const Parametrization> fixed_over(const std::array<BSplineBasis, 4>& bases,
                                                  CanonicalCut cut) {
  FieldGeometry geometry;
  for (int axis = 0; axis < 4; ++axis) geometry.domain[axis] = {bases[axis].front(), bases[axis].back()};
  geometry.cut = cut;
  geometry.tip = {{0, cut.length}, {cut.start, cut.start + cut.length}};
  return make_parametrization("fixed", std::move(geometry));
}

std::shared_ptr<const Axes> axes_of(const Parametrization& parametrization,
                                    const std::array<BSplineBasis, 4>& bases) {
  std::array<SpanTable, 4> tables{SpanTable(bases[0]), SpanTable(bases[1]), SpanTable(bases[2]),
                                  SpanTable(bases[3])};
  tables[1].break_at(parametrization.across(0).value, bases[1]);
  return std::make_shared<const Axes>(std::move(tables));
}

void check_count(const std::array<BSplineBasis, 4>& bases, std::size_t coefficients) {
  std::size_t count = 1;
  for (const BSplineBasis& b : bases) count *= static_cast<std::size_t>(b.size());
  CLEFT_CHECK(coefficients, ==, count);
}

Vec3 three(const double (&d)[4]) { return {d[0], d[1], d[2]}; }

}  // namespace

Field::Field(std::shared_ptr<const Parametrization> parametrization, std::array<BSplineBasis, 4> bases,
             std::vector<Vec3> coefficients)
    : parametrization_(std::move(parametrization)),
      bases_(std::move(bases)),
      coefficients_((check_count(bases_, coefficients.size()), std::move(coefficients))),
      axes_(axes_of(*parametrization_, bases_)),
      grid_(bases_, *axes_, coefficients_),
      kernels_(&kernel_table(available_kernels().back())) {
  for (const Vec3& c : coefficients_) largest_coefficient_ = std::max(largest_coefficient_, norm(c));
}

Field::Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
             CanonicalCut cut)
    : Field(fixed_over({u, v, w, t}, cut), {u, v, w, t}, std::move(coefficients)) {}

BasisPlace Field::mapped(const Vec3& uvw, Side side, double t) const {
  const Place place{uvw, side, t};
  BasisPlace result;
  parametrization_->map({&place, 1}, &result);
  return result;
}

Vec3 Field::displacement(const Vec3& uvw, Side side, double t) const {
  const BasisPlace place = mapped(uvw, side, t);
  Vec3 d;
  kernels_->values(*axes_, grid_, &place, 1, &d);
  return d;
}

void Field::displacements(std::span<const Place> places, std::span<Vec3> out) const {
  CLEFT_CHECK(places.size(), ==, out.size());
  constexpr std::size_t at_once = 64;
  BasisPlace mapped_places[at_once];
  for (std::size_t begin = 0; begin < places.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, places.size() - begin);
    parametrization_->map(places.subspan(begin, count), mapped_places);
    kernels_->values(*axes_, grid_, mapped_places, count, &out[begin]);
  }
}

Derivatives Field::derivatives(const Vec3& uvw, Side side, double t) const {
  const BasisPlace place = mapped(uvw, side, t);
  const Parametrization& p = *parametrization_;
  const double time = p.inside(t, 3);
  double v = p.inside(uvw.y, 1);
  if (v == 0 && side == Side::both) {
    const Derivatives l = derivatives(uvw, Side::left, t), r = derivatives(uvw, Side::right, t);
    return {lerp(l.value, r.value, 0.5), lerp(l.by_u, r.by_u, 0.5), lerp(l.by_v, r.by_v, 0.5),
            lerp(l.by_w, r.by_w, 0.5), lerp(l.by_t, r.by_t, 0.5)};
  }
  if (v == 0 && side == Side::left) v = -std::numeric_limits<double>::min();  // for the slope from the left
  Gradient g;
  kernels_->gradient(*axes_, grid_, place, g);
  const auto along = p.along(p.inside(uvw.x, 0), time);
  return {three(g.value), along.by_u * three(g.by[0]), p.across(v).slope * three(g.by[1]),
          p.height(p.inside(uvw.z, 2)).slope * three(g.by[2]),
          along.by_t * three(g.by[0]) + p.time(time).slope * three(g.by[3])};
}

double Field::contraction_tolerance() const {
  return std::max(0.1 * report.spline_error, 1e-6) * report.largest_displacement;
}

void Field::quantity(std::size_t index, const Vec3& uvw, Side side, double t, std::span<double> out) const {
  const Quantity& q = quantities.at(index);
  bases_of(q, *this).value(q, uvw, side, t, out);
}

void Field::value(const Quantity& q, const Vec3& uvw, Side side, double t, std::span<double> out) const {
  const std::size_t components = q.components;
  CLEFT_CHECK(out.size(), ==, components);
  CLEFT_CHECK(q.coefficients.size(), ==, coefficients_.size() * components);
  Stencil s;
  kernels_->locate(*axes_, mapped(uvw, side, q.time.value_or(t)), s);
  std::size_t size[4], last[4];  // functions beyond a basis of lower degree have no coefficients
  for (int axis = 0; axis < 4; ++axis) {
    size[axis] = static_cast<std::size_t>(bases_[axis].size());
    last[axis] = std::min<std::size_t>(4, size[axis] - s.first[axis]);
  }
  std::fill(out.begin(), out.end(), 0);
  for (std::size_t i = 0; i < last[0]; ++i)
    for (std::size_t j = 0; j < last[1]; ++j)
      for (std::size_t k = 0; k < last[2]; ++k) {
        const double weight = s.weight[0][i] * s.weight[1][j] * s.weight[2][k];
        const std::size_t row = ((s.first[0] + i) * size[1] + s.first[1] + j) * size[2] + s.first[2] + k;
        const double* c = &q.coefficients[(row * size[3] + s.first[3]) * components];
        for (std::size_t l = 0; l < last[3]; ++l)
          for (std::size_t d = 0; d < components; ++d) out[d] += weight * s.weight[3][l] * *c++;
      }
}

const Field& bases_of(const Quantity& quantity, const Field& field) {
  return quantity.own ? *quantity.own : field;
}

double raw_bytes(const Field& field) {
  int components = field.report.largest_displacement > 0 || field.quantities.empty() ? 3 : 0;
  for (const Quantity& quantity : field.quantities) components += quantity.components;
  return field.report.raw_bytes() * components / 3;
}

}  // namespace cleft
