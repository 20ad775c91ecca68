// How firm skin is where bone is near below it, so that each cut is felt as its own place is.
#pragma once

#include <functional>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// The stiffness of a field's skin and tissue where there is bone below, over that of the field's case. As in
/// a body the tissue ends at the bone, its layers become thinner in proportion, and bone is springs of 1000 E
/// / patch.height: docs/formats.md. 1 everywhere for a field that does not know skin, tissue and foundation.
class FirmnessAboveBone {
 public:
  explicit FirmnessAboveBone(const Field& field);

  /// `tissue`: mm from the skin to the bone; from patch.height on it is on the case's springs. Thinner than a
  /// twentieth of that it is as firm as there.
  double at(double tissue) const;

 private:
  double whole_, free_ = 1;    // patch.height; without bone
  std::vector<double> table_;  // on bone, at thicknesses in even ratios up to whole_
};

/// Of places of skin, by how far the bone is from them: ScalpelCutting::Setup. Null without a distance.
std::function<double(const Vec3& place)> firmness_above_bone(
    const Field& field, std::function<double(const Vec3& place)> distance);

}  // namespace cleft
