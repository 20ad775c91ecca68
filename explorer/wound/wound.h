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

  /// Whether the cut begins in the wound of an earlier one, and leads away from it.
  bool leaves(const Wound& earlier) const {
    constexpr double on_wound = 0.1, rounding = 1e-3, least_sine = 0.3;  // depths of the cut
    const ScalpelPath &own = incision->path(), &other = earlier.incision->path();
    const double depth = field.shape().cut().depth / scale();
    const PathCoordinates start = other.coordinates(own.at(0).position),
                          inside = other.coordinates(own.at(std::min(depth, own.length())).position);
    const double beyond = inside.v > 0 ? -start.v : start.v;
    return start.s > 0 && start.s * earlier.scale() < earlier.complete() && std::abs(start.w) < depth &&
           -rounding * depth < beyond && beyond < on_wound * depth &&
           std::abs(inside.v - start.v) > least_sine * std::min(depth, own.length());
  }

  /// Where a later cut leaves this one, mm along the path; none: it does not.
  std::optional<double> left_at(const Wound& later) const {
    if (later.volume.left() != incision) return std::nullopt;
    return scale() * incision->path().coordinates(later.incision->path().at(0).position).s;
  }

  const Incision* incision;
  VaryingField field;
  IncisionVolume volume;
  TissueAboveBone tissue = {};  ///< if there is bone below
  Followed followed;            ///< by the field
};

}  // namespace cleft
