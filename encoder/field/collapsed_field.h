// A field at a fixed time: three-variate, 64 terms for each point.
#pragma once

#include <cstddef>
#include <span>

#include "encoder/field/control_grid.h"
#include "encoder/field/place.h"

namespace cleft {

class Field;

/// Made by Field::collapse(). Reusing an object allocates no memory once it is large enough.
class CollapsedField {
 public:
  /// As Field::displacement() at time().
  Vec3 displacement(const Vec3& uvw, Side side) const;
  /// The same at many places, whose own times are ignored.
  void displacements(std::span<const Place> places, std::span<Vec3> out) const;
  double time() const { return time_; }

 private:
  friend class Field;

  const Field* field_ = nullptr;
  double time_ = 0;
  std::ptrdiff_t stride_[2] = {0, 0};  // along and across; 4 doubles for each control point
  Lines values_;
};

}  // namespace cleft
