#include "explorer/scene/cut_surface.h"

#include "base/error.h"

namespace cleft {

CutSurface::CutSurface(const SurfaceMesh& mesh, const std::vector<ScalpelPath>& paths)
    : mesh_(mesh), original_points_(static_cast<int>(mesh.points.size())) {
  for (const ScalpelPath& path : paths) {
    try {
      cuts_.push_back(std::make_unique<Incision>(mesh_, path));
      cuts_.back()->advance_to(path.length());
    } catch (const InputError& e) {
      throw InputError("cut " + std::to_string(cuts_.size() + 1) + ": " + e.what());
    }
  }
}

WoundSurface wound_surface_of(const CutMesh& mesh, int original_points) {
  WoundSurface surface;
  surface.original_points = original_points;
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
