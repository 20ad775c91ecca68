#include "explorer/wound/varying_field.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/stations.h"

namespace cleft {

namespace {

/// Of a length: lengths of two fields that differ by less are the same but for the rounding of their files.
constexpr double rounding = 1e-9;

bool same(double x, double y) { return std::abs(x - y) <= rounding * (std::abs(x) + std::abs(y)); }

/// But for depths.
bool same_cut_and_patch(const Field& a, const Field& b) {
  for (const int axis : {0, 1, 3})
    if (!same(a.domain(axis).front, b.domain(axis).front) || !same(a.domain(axis).back, b.domain(axis).back))
      return false;
  return same(a.cut().start, b.cut().start) && same(a.cut().length, b.cut().length);
}

bool same_depths(const Field& a, const Field& b) {
  return same(a.cut().depth, b.cut().depth) && same(a.domain(2).front, b.domain(2).front) &&
         same(a.domain(2).back, b.domain(2).back);
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
    if (!same_cut_and_patch(shape(), *field) || !same_depths(shape(), *field))
      throw InputError("the fields to be superposed are not of the same cut in the same patch");
}

VaryingField::VaryingField(std::shared_ptr<const Field> shape, std::vector<StationField> stations)
    : along_(std::make_shared<Along>()) {
  CLEFT_CHECK(stations.size(), >, 0u);
  along_->shape = std::move(shape);
  for (StationField& one : stations) extend(std::move(one));
}

void VaryingField::extend(StationField station) {
  if (!same_cut_and_patch(*along_->shape, *station.field))
    throw InputError("the fields of a family are not of cuts of one length in patches of one size");
  along_->stations.push_back(station.s), along_->prestress.push_back(station.prestress);
  along_->direction.push_back(station.along), along_->outside.push_back(station.outside);
  along_->tilt.push_back(station.tilt);
  along_->contraction_tolerance =
      std::max(along_->contraction_tolerance, station.field->contraction_tolerance());
  along_->fields.push_back(std::move(station.field));
}

double VaryingField::contraction_tolerance() const {
  if (along_) return along_->contraction_tolerance;
  double tolerance = 0;
  for (const Field* field : fields_) tolerance = std::max(tolerance, field->contraction_tolerance());
  return tolerance;
}

void VaryingField::parts_at(double s, std::vector<Part>& parts) const {
  parts.clear();
  if (along_) {
    const auto [a, b, part] = between(along_->stations, s);
    parts.push_back({along_->fields[a].get(), 1 - part});
    if (part > 0) parts.push_back({along_->fields[b].get(), part});
  } else if (weights_.empty()) {
    parts.push_back({fields_.front(), 1});
  } else {
    const auto [a, b, part] = between(stations_, s);
    for (std::size_t k = 0; k < fields_.size(); ++k)
      parts.push_back({fields_[k], (1 - part) * weights_[a][k] + part * weights_[b][k]});
  }
}

/// The bottom of the cut is that of each field, and what is below it keeps its distance.
Vec3 VaryingField::place_in(const Field& field, const Vec3& uvw) const {
  if (!along_) return uvw;
  const double common = shape().cut().depth, own = field.cut().depth;
  return {uvw.x, uvw.y, uvw.z > -common ? uvw.z * own / common : uvw.z + common - own};
}

void VaryingField::contract(const Vec3& uvw, Side side, double s, std::span<const double> stops,
                            History& out) const {
  const double tolerance = contraction_tolerance();
  static thread_local std::vector<Part> parts;
  static thread_local std::vector<History> histories;
  static thread_local std::vector<double> weights;
  parts_at(s, parts);
  if (parts.size() == 1) {
    const Field& field = *parts.front().field;
    return field.contract(place_in(field, uvw), side, tolerance, stops, out, stops.back());
  }
  histories.resize(parts.size()), weights.clear();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& [field, weight] = parts[k];
    field->contract(place_in(*field, uvw), side, tolerance, stops, histories[k], stops.back());
    weights.push_back(weight);
  }
  combine(histories, weights, out);
}

Vec3 VaryingField::displacement(const Vec3& uvw, Side side, double t, double s) const {
  std::vector<Part> parts;
  parts_at(s, parts);
  Vec3 sum;
  for (const auto& [field, weight] : parts)
    sum += weight * field->displacement(place_in(*field, uvw), side, t);
  return sum;
}

Derivatives VaryingField::derivatives(const Vec3& uvw, Side side, double t, double s) const {
  std::vector<Part> parts;
  parts_at(s, parts);
  Derivatives sum{};
  for (const auto& [field, weight] : parts) {
    const Derivatives one = field->derivatives(place_in(*field, uvw), side, t);
    const double deeper =
        along_ && uvw.z > -shape().cut().depth ? field->cut().depth / shape().cut().depth : 1;
    sum.value += weight * one.value;
    sum.by_u += weight * one.by_u, sum.by_v += weight * one.by_v;
    sum.by_w += weight * deeper * one.by_w, sum.by_t += weight * one.by_t;
  }
  return sum;
}

double VaryingField::prestress(double Prestress::*component, double s) const {
  if (along_) {
    const auto [a, b, part] = between(along_->stations, s);
    return (1 - part) * along_->prestress[a].*component + part * along_->prestress[b].*component;
  }
  std::vector<Part> parts;
  parts_at(s, parts);
  double sum = 0;
  for (const auto& [field, weight] : parts)
    sum += weight * parameter_of(*field, field->parameters->skin.prestress.*component);
  return sum;
}

std::optional<Vec3> VaryingField::along(double s) const {
  if (!along_) return std::nullopt;
  const auto [a, b, part] = between(along_->stations, s);
  const Vec3 sum = lerp(along_->direction[a], along_->direction[b], part);
  return norm(sum) > 0 ? normalized(sum) : along_->direction[b];
}

double VaryingField::outside(double s) const {
  if (!along_) return 0;
  const auto [a, b, part] = between(along_->stations, s);
  return std::lerp(along_->outside[a], along_->outside[b], part);
}

double VaryingField::tilt(double s) const {
  if (!along_) return 0;
  const auto [a, b, part] = between(along_->stations, s);
  return std::lerp(along_->tilt[a], along_->tilt[b], part);
}

}  // namespace cleft
