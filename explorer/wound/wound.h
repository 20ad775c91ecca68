// A cut that opens: the incision, its field, and the coordinates of the mesh's vertices in that field.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "explorer/incision/incision.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/path_shape.h"
#include "explorer/wound/varying_field.h"

namespace cleft {

/// Which parts of the shape at each place of a path a field is for.
struct Followed {
  bool bend = false, tilt = false, depth = false, skin = false, twist = false, bone = false;
};

struct Wound {
  /// Builds the volume, once for all that reads it: of the mesh as it is now. After further cuts in the mesh
  /// either LiveReplay keeps it up, or the wound is to be made anew. The incision and the field's own fields
  /// must outlive the wound. `scale`: mm per mesh unit.
  Wound(const Incision& cut, const VaryingField& opened_by, double scale)
      : incision(&cut), field(opened_by), volume(cut, field, scale) {}
  /// With an existing volume for a field of the same shape.
  Wound(const Incision& cut, VaryingField opened_by, IncisionVolume built)
      : incision(&cut), field(std::move(opened_by)), volume(std::move(built)) {
    volume.opened_by(field);
  }

  double scale() const { return volume.scale(); }  ///< mm per mesh unit
  /// The position of the blade when the cut is complete, mm: the end of the path. An extended path ends where
  /// the blade has left it.
  double complete() const {
    return (incision->extended_to() > 0 ? incision->tip() : incision->path().length()) * scale();
  }

  /// How far the blade can go, mm: not beyond the tip of a cut that has stopped within the mesh.
  double reached() const {
    const double length = incision->path().length(), tip = incision->tip();
    constexpr double rounding = 1e-9;
    return (tip < (1 - rounding) * length && !incision->left_mesh() ? tip : length) * scale();
  }

  /// The position of the blade up to which the others feel the cut, once it is made: complete(), but where it
  /// has stopped short of that.
  double felt() const { return incision->is_short_of_end() ? reached() : complete(); }

  /// mm, at s mm of the path.
  double depth(double s) const { return incision->path().depth(s / scale()) * scale(); }

  /// mm; the usual one where the field does not record it.
  double skin_thickness() const {
    constexpr double usual = 1.5;
    const auto& parameters = field.shape().parameters;
    return parameters.value_or(parameters->skin.thickness, usual);
  }

  /// Whether the cut begins in the wound of an earlier one, and leads away from it; or ends there. Where a
  /// path ends that is found as the blade goes is not known until then.
  bool opens_into(const Wound& earlier, bool at_end) const {
    constexpr double on_wound = 0.1, rounding = 1e-3, least_sine = 0.3;  // depths of the cut
    if (at_end && incision->extended_to() > 0) return false;
    const ScalpelPath &own = incision->path(), &other = earlier.incision->path();
    const double depth = field.shape().cut().depth / scale(), way = std::min(depth, own.length());
    const PathCoordinates end = other.coordinates(own.at(at_end ? own.length() : 0).position),
                          inside = other.coordinates(own.at(at_end ? own.length() - way : way).position);
    const double beyond = inside.v > 0 ? -end.v : end.v;
    return end.s > 0 && end.s * earlier.scale() < earlier.complete() && std::abs(end.w) < depth &&
           -rounding * depth < beyond && beyond < on_wound * depth &&
           std::abs(inside.v - end.v) > least_sine * way;
  }

  /// Where this one opens into an earlier one, with its start or its end; null: it does not.
  const IncisionVolume::Mouth* mouth_in(const Wound& earlier) const {
    for (const bool at_end : {false, true})
      if (const auto& mouth = volume.mouth(at_end); mouth && mouth->earlier == earlier.incision)
        return &*mouth;
    return nullptr;
  }

  /// Where a later cut opens into this one, mm along the path, with its start or its end; none: it does not.
  std::optional<double> mouth_of(const Wound& later, bool at_end) const {
    const auto& mouth = later.volume.mouth(at_end);
    if (!mouth || mouth->earlier != incision) return std::nullopt;
    const Vec3 place = later.incision->path().at(mouth->s / later.scale()).position;
    return scale() * incision->path().coordinates(place).s;
  }

  const Incision* incision;
  VaryingField field;
  IncisionVolume volume;
  TissueAboveBone tissue = {};  ///< if there is bone below
  Followed followed;            ///< by the field
};

}  // namespace cleft
