// Columns of nodes below the skin: their directions, lengths and layers.
#pragma once

#include <vector>

#include "explorer/body/lined_surface.h"
#include "explorer/body/surface_index.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// Depths of the layers' nodes below the skin, mm: 0, then along the cut, whose deepest layer is `bottom`,
/// then growing down to the thickness.
struct Layers {
  std::vector<double> depth;
  int bottom = 0;    ///< the layer of the cut's closed nodes
  double front = 0;  ///< how far above these the cut ends, mm
};
Layers make_layers(const Parameters& parameters, double depth);

/// Of each point of the skin.
struct Extrusion {
  std::vector<Vec3> inward;       ///< unit
  std::vector<double> thickness;  ///< mm, along it
  std::vector<bool> on_bone;      ///< whether it ends at bone
  int thinned = 0;
  Vec3 thinnest;
  double blade_turn = 0;  ///< radians, the largest between a blade and its column
  Vec3 blade_turned_at;
  double least_determinant = 0;
  std::vector<int> turned;  ///< triangles below which wedges are turned inside out, however thin they are

  /// Of the cut's layers, mm: less than asked for where the tissue is too thin.
  double cut_depth(const Layers& layers, int point) const;
  /// The node of a layer. Where the tissue is thinner than the layers, those below the cut are compressed
  /// first, and then all.
  Vec3 node(const LinedSurface& surface, const Layers& layers, int point, int layer) const;
};

/// Directions are those of the blades on the cuts (`blade`: by point, zero elsewhere), and elsewhere mean
/// normals; they turn from one to the other over a distance in proportion to the blade's tilt. Thickness is
/// measured along them such that leaning columns end as deep as upright ones. Where wedges would be turned
/// inside out, columns are made thinner, down to a tenth of the thickness, and go nearer to the mean of those
/// around them; those of blades at last, as noise of a path's directions, and blades that are too flat, do
/// not leave them room. Throws InputError where bone is above the skin.
Extrusion extrude(const LinedSurface& surface, const Layers& layers, const std::vector<Vec3>& blade,
                  const SurfaceIndex* bone);

/// Unit normals of a surface's points, outward.
std::vector<Vec3> normals_of(const SurfaceMesh& mesh);

}  // namespace cleft
