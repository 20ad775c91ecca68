#include "explorer/scene/mesh_scene.h"

#include <algorithm>

namespace cleft {

MeshScene::MeshScene(std::shared_ptr<const CutSurface> cut, std::shared_ptr<const Field> field)
    : cut_(std::move(cut)), field_(std::move(field)) {
  for (const auto& incision : cut_->cuts()) {
    if (field_) replays_.emplace_back(*field_, *incision, 1);
    duration_ += incision->path().length();
  }
  surface_ = wound_surface_of(cut_->mesh(), cut_->original_points());
  aim_at_cuts();
}

void MeshScene::aim_at_cuts() {
  surface_.outward = {};
  if (cut_->cuts().empty()) {  // from the front, the whole mesh
    Vec3 low = surface_.points.front(), high = low;
    for (const Vec3& p : surface_.points)
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    surface_.middle = 0.5 * (low + high);
    surface_.outward = {0, 0, 1};
    return;
  }
  const ScalpelPath& path = cut_->cuts().front()->path();
  const PathFrame middle = path.at(path.length() / 2);
  surface_.middle = middle.position;
  surface_.along = middle.along;
  constexpr int samples = 20;
  for (int i = 0; i <= samples; ++i) surface_.outward += path.at(path.length() * i / samples).outward;
}

void MeshScene::positions(double t, std::vector<Vec3>& out) const {
  out = surface_.points;
  double before = 0;
  for (const Replay& replay : replays_) {
    if (t <= before) break;
    moved_.resize(out.size());
    replay.positions(std::min(t - before, replay.path_length()), moved_);
    for (const ActiveVertex& a : replay.active()) {
      const auto v = static_cast<std::size_t>(a.vertex);
      out[v] += moved_[v] - surface_.points[v];
    }
    before += replay.path_length();
  }
}

void MeshScene::values(Coloring coloring, const Field* reference, double t, std::vector<double>& out) const {
  out.assign(surface_.points.size(), 0);
  if (coloring == Coloring::tissue) return;
  double before = 0;
  for (const Replay& replay : replays_) {
    if (t <= before) break;
    const double s = std::min(t - before, replay.path_length());
    for (const ActiveVertex& a : replay.active()) {
      const bool closed = a.on_cut && a.s >= s;
      const double own_time = std::clamp(s + a.time_offset, 0., field_->cut().length);
      const Place place{a.uvw, closed ? Side::both : a.side, own_time};
      double& value = out[static_cast<std::size_t>(a.vertex)];
      value = std::max(value, a.weight * color_value(coloring, *field_, reference, place));
    }
    before += replay.path_length();
  }
}

}  // namespace cleft
