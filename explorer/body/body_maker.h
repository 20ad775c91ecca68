// From a surface with the paths of cuts to the mesh of a body in which they are simulated.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "explorer/body/surface_index.h"
#include "explorer/body/tissue_layers.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/tension_lines.h"
#include "params/parameters/parameters.h"
#include "solver/body/body.h"

namespace cleft {

/// What a body is made of. Lengths in mm.
struct BodyRequest {
  SurfaceMesh skin;                ///< counter-clockwise from outside
  std::vector<ScalpelPath> paths;  ///< in the order in which they are cut, each with its depth
  std::shared_ptr<const SurfaceIndex> bone = nullptr;  ///< what lies below; null: nothing
  Parameters parameters;  ///< mesh.element_size, grading and front; patch.height: thickness of tissue
  double reach = 40;      ///< of the body around the paths, over the skin
  std::vector<TissueLayer> layers = {};   ///< of the tissue, from the skin down; none: all is one
  std::vector<TensionLine> tension = {};  ///< along skin.prestress_u, at each place their mean; none: from
                                          ///< the first path's start to its end
  bool own_formulation = false;           ///< whether tissue.formulation was asked for
};

/// A path that does not lie on the skin: the cut goes below it, as far as there is skin.
struct OffPath {
  int cut;              ///< from 0
  double off;           ///< mm, of the farthest place that is cut
  Vec3 at;              ///< of the skin, there
  double made, length;  ///< mm, of the cut and of its path
  bool far = false;     ///< farther than the cut is deep
  bool leaves = false;  ///< a part of it has no skin below
};

/// What was made, and where it had to be changed.
struct BodyReport {
  int nodes = 0, wedges = 0, triangles = 0, pairs = 0, frames = 0;
  double least_angle = 0;        ///< of the skin's triangles, degrees
  Vec3 sharpest;                 ///< where
  double least_determinant = 0;  ///< of a wedge: least Jacobian of its corners over its mean
  double least_thickness = 0;    ///< of the tissue, mm
  int thinned = 0;               ///< columns that had to be made thinner, because they would turn inside out
  Vec3 thinnest;                 ///< where
  double blade_turn = 0;         ///< degrees by which the cuts' walls had to be turned from the blade
  Vec3 blade_turned_at;          ///< where
  int left_out = 0;              ///< triangles away from the cuts, below which even a thin body would turn
  Vec3 left_out_at;              ///< of the first of them
  int on_bone = 0;               ///< columns that end at bone
  double least_depth = 0;        ///< of a cut that bone would stop, mm; 0: none
  std::vector<OffPath> off_paths;
  double stiff_tilt = 0;  ///< degrees, of a blade whose thin lips the tissue's formulation makes too stiff
};

/// The tilt of the blade against the normal of the skin, across the path, that it exceeds along a quarter of
/// a path: the largest of any path, degrees.
double tilt_of(const BodyRequest& request);

/// The skin around the paths is cut along them, closed again, meshed with triangles of element_size along the
/// cuts that grow away from them, and extruded inward in layers of wedges down to patch.height, or to the
/// bone. Nodes on the cuts are doubled, fourfold where two cross. Throws InputError where a path does not
/// meet the skin, where bone is above the skin, and where the tissue would have no thickness.
Body make_body(const BodyRequest& request, BodyReport* report = nullptr);

}  // namespace cleft
