// From a volume mesh of one's own, whose cuts have doubled nodes, to the body that is solved.
#pragma once

#include <string>
#include <vector>

#include "explorer/body/own_columns.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/tension_lines.h"
#include "params/parameters/parameters.h"
#include "params/region_materials.h"
#include "solver/body/body.h"

namespace cleft {

/// Lengths in mm.
struct OwnBodyRequest {
  OwnMesh mesh;
  std::vector<double> release;        ///< by node: mm cut when the pair of it opens; empty: along the paths
  std::string regions_name;           ///< of the array of regions, for messages
  std::optional<RegionFile> regions;  ///< none: all is one tissue, all triangles (or quads) are skin
  std::vector<ScalpelPath> paths;     ///< in the order in which they are cut
  Parameters parameters;              ///< mesh.front: how far inside its first closed nodes a cut ends
  std::vector<TensionLine> tension;   ///< as BodyRequest::tension
};

struct OwnBodyReport {
  struct Region {
    std::string name;
    int wedges = 0;
  };
  struct Cut {
    double length, depth;  ///< as the mesh has it, mm: less than its path, or more
  };
  std::vector<Region> regions;
  std::vector<Cut> cuts;
  int on_bone = 0;
  double least_determinant = 0;  ///< of a wedge: least Jacobian of its corners over its mean
};

/// The nodes are those of the mesh, in their order, without those that no wedge has. Left nodes are those
/// whose wedges are at v < 0 of the path. Throws FileError or InputError, which name the cell, node, region
/// or path, and the remedy.
Body own_body(const OwnBodyRequest& request, OwnBodyReport* report = nullptr);

}  // namespace cleft
