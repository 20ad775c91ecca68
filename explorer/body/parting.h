// The copies of nodes on cuts: which triangles have which, while one cut after another divides them.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

class Parting {
 public:
  /// `node`: the number of a point's node in a layer before all cuts. `copy`: makes a copy of a node, below
  /// the given node of the skin (-1: it is of the skin itself), and returns its number. Keeps a reference.
  Parting(const SurfaceMesh& mesh, int layers, std::function<int(int point, int layer)> node,
          std::function<int(int node, int above)> copy);

  /// A cut passes a point, from a neighbour to a neighbour (-1: it begins or ends there), through so many
  /// layers from the skin down.
  struct Visit {
    int point = -1, from = -1, to = -1;
    int layers = 0;
  };
  /// A node and its new copy on the other side of the cut.
  struct Pair {
    int left, right;  ///< right is the copy
    int layer;
    bool reversed;  ///< left is on the right of the cut
  };
  /// The triangles around the point are divided by all edges along which cuts have passed so far; each part
  /// that has lost its connection with the others gets copies of the nodes. Empty where nothing is divided:
  /// at the end of a cut within the skin.
  std::vector<Pair> open(const Visit& visit);

  /// The node of a triangle's corner.
  int node(int triangle, int corner, int layer) const;

 private:
  struct Fan {
    std::vector<int> triangles;  // counter-clockwise; of an open fan from its beginning
    bool closed = true;
    std::vector<int> ahead;                // by triangle: the neighbour on its clockwise edge
    std::vector<std::set<int>> opened;     // by layer: neighbours along whose edges cuts have passed
    std::vector<std::vector<int>> copies;  // by layer, by triangle: its node
  };
  Fan& fan_of(int point);

  const SurfaceMesh& mesh_;
  int layers_;
  std::function<int(int, int)> node_;
  std::function<int(int, int)> copy_;
  std::vector<std::vector<int>> around_;  // by point
  std::map<int, Fan> fans_;               // of points on cuts
};

}  // namespace cleft
