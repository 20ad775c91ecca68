// The cuts of a mesh of one's own: which walls are of which path, and in which order their nodes part.
#pragma once

#include <vector>

#include "explorer/body/own_columns.h"
#include "explorer/incision/scalpel_path.h"
#include "params/meshed_cut.h"
#include "solver/body/body.h"

namespace cleft {

/// An edge of the closed skin below which there are walls.
struct OwnEdge {
  int from, to;                       ///< places, in the direction of the path
  double s_from, s_to;                ///< arc length there
  std::array<int, 2> column, corner;  ///< at the left and at the right; where `from` is in its triangle
  std::array<int, 2> corner_to;
  int layers;  ///< of walls
};

struct OwnCut {
  ScalpelPath path;  ///< from where the mesh's cut begins to where it ends
  std::vector<OwnEdge> edges;
  double depth;  ///< mm, largest
};

/// Finds each path's walls, and makes it as long as they are. Throws FileError for walls without a path, and
/// paths without walls.
std::vector<OwnCut> cuts_of(const OwnColumns& columns, const std::vector<ScalpelPath>& paths,
                            const FrontParts& fronts, const std::string& name);

/// Sets pairs and frames of a body: along the cuts, or by `release` (by node: mm cut when its pair opens).
void open_cuts(const OwnColumns& columns, const std::vector<OwnCut>& cuts, const FrontParts& fronts,
               const std::vector<double>& release, const std::string& name, Body& body);

}  // namespace cleft
