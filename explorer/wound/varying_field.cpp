#include "explorer/wound/varying_field.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

namespace {

/// Of a length: lengths of two fields that differ by less are the same but for the rounding of their files.
constexpr double rounding = 1e-9;

bool same_cut_and_patch(const Field& a, const Field& b) {
  const auto same = [](double x, double y) {
    return std::abs(x - y) <= rounding * (std::abs(x) + std::abs(y));
  };
  for (int axis = 0; axis < 4; ++axis)
    if (!same(a.domain(axis).front, b.domain(axis).front) || !same(a.domain(axis).back, b.domain(axis).back))
      return false;
  return same(a.cut().start, b.cut().start) && same(a.cut().length, b.cut().length) &&
         same(a.cut().depth, b.cut().depth);
}

}  // namespace

double parameter_of(const Field& field, const double& member) {
  if (field.parameters.has(member)) return member;
  const std::string& name = field.parameters.name_of(member);
  throw InputError(
      "the field does not tell " + name +
      ", from which it follows how cuts relieve each other; take the field of a simulated case, give it "
      "to cleft import as --set " +
      name + "=VALUE and encode again, or make one cut");
}

VaryingField::VaryingField(std::vector<const Field*> fields, std::vector<double> stations,
                           std::vector<std::vector<double>> weights)
    : fields_(std::move(fields)), stations_(std::move(stations)), weights_(std::move(weights)) {
  CLEFT_CHECK(stations_.size(), ==, weights_.size());
  for (const Field* field : fields_)
    if (!same_cut_and_patch(shape(), *field))
      throw InputError("the fields to be superposed are not of the same cut in the same patch");
}

double VaryingField::contraction_tolerance() const {
  double tolerance = 0;
  for (const Field* field : fields_) tolerance = std::max(tolerance, field->contraction_tolerance());
  return tolerance;
}

std::vector<double> VaryingField::weights_at(double s) const {
  if (weights_.empty()) return {1};
  const auto next =
      static_cast<std::size_t>(std::upper_bound(stations_.begin(), stations_.end(), s) - stations_.begin());
  const std::size_t a = next == 0 ? 0 : next - 1, b = std::min(next, stations_.size() - 1);
  const double part = a == b ? 0 : (s - stations_[a]) / (stations_[b] - stations_[a]);
  std::vector<double> weights;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    weights.push_back((1 - part) * weights_[a][k] + part * weights_[b][k]);
  return weights;
}

void VaryingField::contract(const Vec3& uvw, Side side, double s, std::span<const double> stops,
                            History& out) const {
  const double tolerance = contraction_tolerance();
  if (weights_.empty()) return shape().contract(uvw, side, tolerance, stops, out);
  static thread_local std::vector<History> histories;
  histories.resize(fields_.size());
  for (std::size_t k = 0; k < fields_.size(); ++k)
    fields_[k]->contract(uvw, side, tolerance, stops, histories[k]);
  combine(histories, weights_at(s), out);
}

Vec3 VaryingField::displacement(const Vec3& uvw, Side side, double t, double s) const {
  const std::vector<double> weights = weights_at(s);
  Vec3 sum;
  for (std::size_t k = 0; k < fields_.size(); ++k) sum += weights[k] * fields_[k]->displacement(uvw, side, t);
  return sum;
}

Derivatives VaryingField::derivatives(const Vec3& uvw, Side side, double t, double s) const {
  const std::vector<double> weights = weights_at(s);
  Derivatives sum{};
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const Derivatives one = fields_[k]->derivatives(uvw, side, t);
    sum.value += weights[k] * one.value;
    sum.by_u += weights[k] * one.by_u, sum.by_v += weights[k] * one.by_v;
    sum.by_w += weights[k] * one.by_w, sum.by_t += weights[k] * one.by_t;
  }
  return sum;
}

double VaryingField::prestress(double Prestress::*component, double s) const {
  const std::vector<double> weights = weights_at(s);
  double sum = 0;
  for (std::size_t k = 0; k < fields_.size(); ++k)
    sum += weights[k] * parameter_of(*fields_[k], fields_[k]->parameters->skin.prestress.*component);
  return sum;
}

}  // namespace cleft
