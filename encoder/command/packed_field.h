// A field's spline in messages between processes.
#pragma once

#include "base/ranks/packed.h"
#include "encoder/field/field.h"

namespace cleft {

/// Its spline: without what else a field holds.
void add(Packer& message, const Field& field);
Field take_field(Unpacker& message);

}  // namespace cleft
