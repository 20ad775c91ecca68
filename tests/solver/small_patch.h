// A small case: two layers of elements cut, a few hundred unknowns.
#pragma once

#include "params/parameters/parameters.h"
#include "tests/support/even_piece.h"

namespace cleft {

inline Parameters small_patch() {
  Parameters p = even_piece();
  p.patch.length = 10, p.patch.width = 6, p.patch.height = 3;
  p.cut.length = 6, p.cut.depth = 2;
  p.mesh.element_size = 1;
  return p;
}

}  // namespace cleft
