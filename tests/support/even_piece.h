// A piece of tissue whose mesh can be counted by hand.
#pragma once

#include "params/parameters/parameters.h"

namespace cleft {

/// 60 x 40 x 8 mm with free edges, even elements of 1 mm, and a cut that ends at nodes.
inline Parameters even_piece() {
  Parameters p;
  p.patch = {60, 40, 8};
  p.mesh.grading = 1, p.mesh.front = MeshFront::nodes;
  p.skin.edges = SkinEdges::free;
  return p;
}

}  // namespace cleft
