// Where the vertices of a cut mesh are in a body with the same cuts: between which of its nodes.
#pragma once

#include <array>
#include <vector>

#include "explorer/incision/incision.h"
#include "solver/body/body.h"

namespace cleft {

/// What a vertex takes of three nodes; the ends and the bottom of a cut take of both sides.
struct VertexPlace {
  int vertex;
  std::array<int, 3> nodes;
  std::array<double, 3> weights;  ///< those of the nodes, less toward vertices that stay
};

/// Of all vertices that move with the body, in their order. `scale` is mm per mesh unit.
std::vector<VertexPlace> places_in(const Body& body, const std::vector<const Incision*>& cuts, double scale);

}  // namespace cleft
