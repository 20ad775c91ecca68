#include "encoder/field/quantity_fields.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {

constexpr std::size_t at_once = 3;

}  // namespace

QuantityFields::QuantityFields(const Field& field, std::size_t index) {
  const Quantity& quantity = field.quantities.at(index);
  components_ = static_cast<std::size_t>(quantity.components), time_ = quantity.time;
  const Field& over = bases_of(quantity, field);
  const std::size_t points = over.coefficients().size();
  CLEFT_CHECK(quantity.coefficients.size(), ==, points * components_);
  for (std::size_t first = 0; first < components_; first += at_once) {
    std::vector<Vec3> some(points);
    for (std::size_t n = 0; n < points; ++n)
      for (std::size_t c = first; c < std::min(first + at_once, components_); ++c)
        some[n][static_cast<int>(c - first)] = quantity.coefficients[n * components_ + c];
    parts_.emplace_back(over.shared_parametrization(),
                        std::array{over.basis(0), over.basis(1), over.basis(2), over.basis(3)},
                        std::move(some));
  }
}

void QuantityFields::at(std::span<const Place> places, std::span<double> out) const {
  CLEFT_CHECK(out.size(), ==, places.size() * components_);
  std::vector<Vec3> values(places.size());
  std::vector<Place> then;
  if (time_) {
    then.assign(places.begin(), places.end());
    for (Place& place : then) place.t = *time_;
    places = then;
  }
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    parts_[part].displacements(places, values);
    const std::size_t first = part * at_once;
    for (std::size_t n = 0; n < places.size(); ++n)
      for (std::size_t c = first; c < std::min(first + at_once, components_); ++c)
        out[n * components_ + c] = values[n][static_cast<int>(c - first)];
  }
}

}  // namespace cleft
