#include "encoder/field/unknowns.h"

#include <algorithm>

#include "encoder/field/parametrization/fixed.h"

namespace cleft {

ControlTies ties_of(const std::string& parametrization, const std::array<BSplineBasis, 4>& bases) {
  const std::array<BSplineBasis, 3> space{bases[0], bases[1], bases[2]};
  return parametrization == FixedParametrization::id ? ControlTies::none(space)
                                                     : ControlTies::following_tip(space);
}

CoefficientGrid places_of(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases) {
  CoefficientGrid places{bases[0].size(), bases[1].size(), bases[2].size(), {}, ties.size()};
  std::vector<bool> placed(static_cast<std::size_t>(ties.size()), false);
  for (int i = 0; i < places.along; ++i)
    for (const ControlTies::Control& control : ties.row(i)) {
      const int unknown = ties.first(i) + control.term[0].unknown;
      const bool own = control.terms == 1 && !placed[unknown];
      places.unknown.push_back(own ? unknown : -1);
      if (own) placed[unknown] = true;
    }
  return places;
}

namespace {

/// `value_of` a number among `values`.
template <class Number, class ValueOf>
std::vector<Vec3> tied(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases,
                       std::span<const Number> values, const ValueOf& value_of) {
  const std::size_t n = static_cast<std::size_t>(ties.size()), T = bases[3].size();
  const std::size_t slices = n == 0 ? T : values.size() / (3 * n), skipped = T - slices;
  std::vector<Vec3> points(static_cast<std::size_t>(bases[0].size()) * bases[1].size() * bases[2].size() * T);
  Vec3* point = points.data();
  for (int i = 0; i < ties.rows(); ++i)
    for (const ControlTies::Control& control : ties.row(i)) {
      for (int term = 0; term < control.terms; ++term) {
        const Number* value = values.data() + ties.first(i) + control.term[term].unknown;
        for (int c = 0; c < 3; ++c)
          for (std::size_t l = skipped; l < T; ++l, value += n)
            point[l][c] += control.term[term].weight * value_of(*value);
      }
      point += T;
    }
  return points;
}

}  // namespace

std::vector<Vec3> control_points(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases,
                                 std::span<const double> values) {
  return tied(ties, bases, values, [](double value) { return value; });
}

std::vector<Vec3> control_points(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases,
                                 std::span<const std::int64_t> values, double quantum) {
  return tied(ties, bases, values, [&](std::int64_t value) { return static_cast<double>(value) * quantum; });
}

std::vector<double> multiples(std::span<const std::int64_t> values, double quantum) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const std::int64_t value : values) result.push_back(static_cast<double>(value) * quantum);
  return result;
}

Unknowns unknowns_of(const Field& field, const CoefficientGrid& places, double unit) {
  return unknowns_of(field.coefficients(), field.basis(3), places, unit);
}

Unknowns unknowns_of(std::span<const Vec3> points, const BSplineBasis& time, const CoefficientGrid& places,
                     double unit) {
  const std::size_t T = time.size(), n = static_cast<std::size_t>(places.unknowns);
  bool zero = T > 1;
  for (std::size_t at = 0; at < points.size() && zero; at += T) zero = points[at] == Vec3{};
  const std::size_t skipped = zero ? 1 : 0, slices = T - skipped;
  Unknowns result{static_cast<int>(slices), std::vector<double>(3 * slices * n)};
  for (std::size_t place = 0; place < places.unknown.size(); ++place)
    if (const int unknown = places.unknown[place]; unknown >= 0)
      for (int c = 0; c < 3; ++c)
        for (std::size_t l = 0; l < slices; ++l)
          result.values[(c * slices + l) * n + static_cast<std::size_t>(unknown)] =
              points[place * T + l + skipped][c] / unit;
  return result;
}

std::vector<Vec3> quantised(std::span<const Vec3> points, const ControlTies& ties,
                            const std::array<BSplineBasis, 4>& bases, double quantum, double farthest) {
  const CoefficientGrid places = places_of(ties, bases);
  const Unknowns unknowns = unknowns_of(points, bases[3], places, quantum);
  const auto values = round_coefficients(places, unknowns.slices, unknowns.values, farthest);
  return control_points(ties, bases, values, quantum);
}

Field quantised(const Field& field, double quantum, double farthest) {
  const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  const ControlTies ties = ties_of(field.parametrization().name(), bases);
  Field result(field.shared_parametrization(), bases,
               quantised(field.coefficients(), ties, bases, quantum, farthest));
  result.parameters = field.parameters, result.case_hash = field.case_hash, result.report = field.report;
  result.quantities = field.quantities, result.by_parameter = field.by_parameter;
  result.interpolation = field.interpolation, result.source = field.source;
  result.tissue = field.tissue;
  result.quantum = quantum;
  return result;
}

}  // namespace cleft
