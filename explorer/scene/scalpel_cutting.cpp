#include "explorer/scene/scalpel_cutting.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/stopwatch.h"

namespace cleft {

namespace {
constexpr double beside = 5;   // mm: a scalpel farther from the path does not follow it
constexpr double ahead = 10;   // mm: how far ahead of the tip the path is looked at
constexpr double told = 2e-3;  // mm: smaller motions of the skin are not felt
}  // namespace

ScalpelCutting::ScalpelCutting(const SurfaceMesh& mesh, const std::optional<ScalpelPath>& path,
                               std::optional<Field> field, double scale)
    : scale_(scale), field_(std::move(field)) {
  SurfaceMesh felt = mesh;
  if (path) {
    incision_.emplace(mesh, *path);
    felt = incision_->mesh().surface();
  }
  for (Vec3& p : felt.points) p *= scale_;
  surface_ = std::make_unique<ContactSurface>(felt.points, felt.triangles);
}

double ScalpelCutting::cut_length() const {
  return incision_ ? scale_ * (incision_->tip() - incision_->start()) : 0;
}

void ScalpelCutting::step(const HapticState& scalpel) {
  ++figures_.steps;
  if (!incision_) return;
  if (const double s = reached(scalpel); s > incision_->tip() && figures_.stopped.empty()) cut_to(s);
  if (field_) open();
}

/// Arc length of the path, mesh units, that the blade has come to; 0 where it does not cut.
double ScalpelCutting::reached(const HapticState& scalpel) const {
  if (scalpel.phase != Phase::cutting || !scalpel.pose.cutting) return 0;
  const double tip = incision_->tip();
  const PathCoordinates at = incision_->path().coordinates(1 / scale_ * scalpel.pose.tip,
                                                           tip - ahead / scale_, tip + ahead / scale_);
  return std::abs(at.v) * scale_ < beside ? at.s : 0;
}

void ScalpelCutting::cut_to(double s) {
  Stopwatch watch;
  try {
    incision_->advance_to(s);
  } catch (const InputError& e) {
    figures_.stopped = e.what();
  }
  figures_.cut.add(watch.lap());
  const CutMesh& mesh = incision_->mesh();
  displacements_.resize(mesh.vertices().size());
  changed_.clear(), vertices_.clear(), moved_.clear();
  for (const int t : incision_->changed_triangles()) {
    if (static_cast<std::size_t>(t) >= mesh.triangles().size()) {
      changed_.push_back({t, {}});
      continue;
    }
    const CutMesh::Triangle& now = mesh.triangle(t);
    changed_.push_back({t, {now.vertex, now.region != Region::skin}});
    vertices_.insert(vertices_.end(), now.vertex.begin(), now.vertex.end());
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (const int v : vertices_)
    moved_.push_back({v, scale_ * mesh.position(v) + displacements_[static_cast<std::size_t>(v)]});
  watch.lap();
  surface_->update(moved_, changed_);
  figures_.update.add(watch.lap());
  ++figures_.cuts;
  figures_.triangles_cut += changed_.size();
  if (field_) find_active();
}

/// Which vertices the field moves changes with the cut, and where they lie in it does not.
void ScalpelCutting::find_active() {
  if (incision_->chain().size() < 3) return;
  active_ = active_vertices(*incision_, *field_, scale_);
  places_.resize(active_.size());
  values_.resize(active_.size());
  opened_ = -1;
}

void ScalpelCutting::open() {
  if (active_.empty()) return;
  const double tip = incision_->tip() * scale_;
  if (tip == opened_ && figures_.waiting == 0) return;
  Stopwatch watch;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const ActiveVertex& a = active_[i];
    places_[i] = {a.uvw, a.side, std::clamp(tip + a.time_offset, 0., field_->cut().length)};
  }
  field_->displacements(places_, values_);
  moved_.clear();
  figures_.waiting = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = (next_active_ + k) % active_.size();
    const ActiveVertex& a = active_[i];
    const Vec3 here = a.in_mesh(values_[i]);
    Vec3& before = displacements_[static_cast<std::size_t>(a.vertex)];
    if (squared_norm(here - before) <= told * told) continue;
    if (moved_.size() == most_moved) {
      if (figures_.waiting++ == 0) next_active_ = i;
      continue;
    }
    before = here;
    moved_.push_back({a.vertex, scale_ * incision_->mesh().position(a.vertex) + here});
  }
  opened_ = tip;
  if (!moved_.empty()) surface_->update(moved_, {});
  figures_.open.add(watch.lap());
}

}  // namespace cleft
