#include "explorer/wound/mesh_cuts.h"

#include <algorithm>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "explorer/incision/local_coordinates.h"
#include "explorer/incision/places_before.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/tissue_colors.h"

namespace cleft {

namespace {

IncisionOptions incision_options(const MeshCutsOptions& options, const ScalpelPath& path,
                                 const Field* field) {
  IncisionOptions result;
  if (options.max_edge && *options.max_edge > 0 && *options.max_edge < path.length() * options.scale / 1000)
    throw InputError("--max-edge " + shortest(*options.max_edge) +
                     ": at least a thousandth of the path's length, " +
                     shortest(path.length() * options.scale / 1000) + " mm");
  if (options.max_edge) result.max_edge = *options.max_edge / options.scale;
  if (field) result.reach = reach_of(*field, options.scale);
  return result;
}

}  // namespace

MeshCuts::MeshCuts(const SurfaceMesh& surface, const Vec3& origin, const std::vector<ScalpelPath>& paths,
                   const Field* field, const MeshCutsOptions& options)
    : scale_(options.scale), origin_(origin), uncut_(moved(surface, -origin)), mesh_(uncut_) {
  for (const ScalpelPath& path : paths) {
    const double length = path.length() * scale_;
    const bool last = &path == &paths.back();
    const double progress = last ? std::min(options.progress.value_or(length), length) : length;
    make(path.moved(-origin_), incision_options(options, path, field), progress / scale_);
    progress_ += progress;
  }
}

void MeshCuts::make(ScalpelPath path, const IncisionOptions& options, double progress) {
  Stopwatch watch;
  try {
    made_.push_back(std::make_unique<Incision>(mesh_, std::move(path), options));
    watch.lap();
    made_.back()->advance_to(progress);
  } catch (const InputError& e) {
    if (origin_ == Vec3{}) throw;
    throw InputError(e.what() + std::string(" (places relative to ") + place_of(origin_) + ")");
  }
  stepping_ += watch.lap(), seconds_ += watch.seconds();
  list_.push_back(made_.back().get());
}

std::vector<double> depths_of(const CutMesh& mesh, double scale) {
  std::vector<double> depths;
  for (const CutMesh::Vertex& v : mesh.vertices()) depths.push_back(v.depth * scale);
  return depths;
}

std::vector<double> regions_of(const CutMesh& mesh) {
  std::vector<double> regions;
  for (const CutMesh::Vertex& v : mesh.vertices())
    regions.push_back(v.depth_fraction == 0 ? 0 : side_of(v.kind) == Side::right ? 2 : 1);
  return regions;
}

std::vector<double> depth_fractions_of(const CutMesh& mesh) {
  std::vector<double> fractions;
  for (const CutMesh::Vertex& v : mesh.vertices()) fractions.push_back(v.depth_fraction);
  return fractions;
}

std::vector<PointColor> MeshCuts::colors() const {
  if (uncut_.colors.empty()) return {};
  return with_tissue(PlacesBefore(uncut_).carried(mesh_, uncut_.colors), depth_fractions_of(mesh_));
}

std::vector<double> MeshCuts::along() const {
  std::vector<double> along;
  for (const CutMesh::Vertex& v : mesh_.vertices()) {
    const bool on_cut = v.kind != VertexKind::skin;
    along.push_back(scale_ * (on_cut ? v.s : list_.back()->path().coordinates(v.position).s));
  }
  return along;
}

}  // namespace cleft
