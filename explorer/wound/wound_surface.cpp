#include "explorer/wound/wound_surface.h"

#include <utility>

namespace cleft {

WoundSurface wound_surface_of(const CutMesh& mesh, int original_points, std::vector<PointColor> colors) {
  WoundSurface surface;
  surface.original_points = original_points;
  surface.colors = std::move(colors);
  for (const CutMesh::Vertex& v : mesh.vertices()) {
    surface.points.push_back(v.position);
    surface.depth_fraction.push_back(v.depth_fraction);
  }
  for (const CutMesh::Triangle& t : mesh.triangles()) {
    surface.triangles.push_back(t.vertex);
    surface.regions.push_back(t.region);
  }
  return surface;
}

}  // namespace cleft
