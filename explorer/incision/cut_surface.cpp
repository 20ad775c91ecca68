#include "explorer/incision/cut_surface.h"

#include "base/error.h"
#include "explorer/incision/places_before.h"

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
  if (!mesh.colors.empty()) colors_ = PlacesBefore(mesh).carried(mesh_, mesh.colors);
}

}  // namespace cleft
