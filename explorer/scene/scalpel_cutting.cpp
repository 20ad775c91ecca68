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
                               std::optional<CutFields> fields, double scale)
    : scale_(scale), fields_(std::move(fields)) {
  SurfaceMesh felt = mesh;
  if (path) {
    incision_.emplace(mesh, *path);
    felt = incision_->mesh().surface();
    if (fields_) field_ = fields_->along(*incision_, scale_);
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
  if (!field_) return;
  if (!opening_) opening_ = std::make_unique<LiveReplay>(*field_, *incision_, scale_);
  opening_->follow();
  tell();
}

void ScalpelCutting::open() {
  if (!opening_) return;
  const double tip = incision_->tip() * scale_;
  Stopwatch watch;
  opening_->move_to(tip);
  tell();
  moved_.clear();
  for (; !untold_.empty() && moved_.size() < most_moved; untold_.pop_front()) {
    const int v = untold_.front();
    is_untold_[static_cast<std::size_t>(v)] = false;
    if (static_cast<std::size_t>(v) >= opening_->vertex_count()) continue;
    displacements_[static_cast<std::size_t>(v)] = scale_ * opening_->displacement(v);
    moved_.push_back({v, scale_ * opening_->position(v)});
  }
  figures_.waiting = untold_.size();
  if (!moved_.empty()) surface_->update(moved_, {});
  figures_.open.add(watch.lap());
}

/// Takes note of those that have moved so far that it can be felt.
void ScalpelCutting::tell() {
  displacements_.resize(opening_->vertex_count());
  is_untold_.resize(std::max(is_untold_.size(), displacements_.size()));
  for (const int v : opening_->touched()) {
    const auto i = static_cast<std::size_t>(v);
    if (is_untold_[i] || squared_norm(scale_ * opening_->displacement(v) - displacements_[i]) <= told * told)
      continue;
    is_untold_[i] = true;
    untold_.push_back(v);
  }
}

}  // namespace cleft
