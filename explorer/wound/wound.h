// A cut that opens: the incision, the field that opens it, and where the mesh's vertices are in that field.
#pragma once

#include "explorer/incision/incision.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/varying_field.h"

namespace cleft {

struct Wound {
  /// Builds the volume, once for all that reads it: of the mesh as it is now. After further cuts in the mesh
  /// either LiveReplay keeps it up, or the wound is to be made anew. The incision and the field's own fields
  /// must outlive the wound. `scale`: mm per mesh unit.
  Wound(const Incision& cut, const VaryingField& opened_by, double scale)
      : incision(&cut), field(opened_by), volume(cut, field.shape(), scale) {}
  /// With a volume that was built already, of the same field's shape.
  Wound(const Incision& cut, VaryingField opened_by, IncisionVolume built)
      : incision(&cut), field(std::move(opened_by)), volume(std::move(built)) {}

  double scale() const { return volume.scale(); }  ///< mm per mesh unit
  /// Where the blade is once the cut is complete, mm: at the end of the path. A path that was led on ends
  /// where the blade has left it.
  double complete() const {
    return (incision->led() > 0 ? incision->tip() : incision->path().length()) * scale();
  }

  const Incision* incision;
  VaryingField field;
  IncisionVolume volume;
};

}  // namespace cleft
