// A further quantity of a field at many places.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// The quantity's components as fields, three at a time, which are evaluated as displacements are: five times
/// as fast as Field::quantity().
class QuantityFields {
 public:
  QuantityFields(const Field& field, std::size_t index);

  std::size_t components() const { return components_; }
  /// Values at all places, place by place.
  void at(std::span<const Place> places, std::span<double> out) const;

 private:
  std::size_t components_;
  std::optional<double> time_;
  std::vector<Field> parts_;
};

}  // namespace cleft
