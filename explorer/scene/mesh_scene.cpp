#include "explorer/scene/mesh_scene.h"

#include <algorithm>

namespace cleft {

MeshScene::MeshScene(std::shared_ptr<const CutSurface> cut, const std::optional<CutFields>& fields,
                     std::shared_ptr<const SimulatedWounds> simulated)
    : cut_(std::move(cut)), fields_(fields), simulated_(std::move(simulated)) {
  std::vector<Wound> wounds;
  for (const auto& incision : cut_->cuts()) {
    if (fields_) wounds.push_back(fields_->wound(*incision, 1));
    duration_ += incision->path().length();
  }
  if (!wounds.empty()) wounds_ = std::make_shared<ReplayedWounds>(std::move(wounds));
  WoundSurface surface = wound_surface_of(cut_->mesh(), cut_->original_points(), cut_->colors());
  aim_at_cuts(surface);
  surface_ = std::make_shared<const WoundSurface>(std::move(surface));
}

void MeshScene::aim_at_cuts(WoundSurface& surface) const {
  surface.outward = {};
  if (cut_->cuts().empty()) {  // from the front, the whole mesh
    Vec3 low = surface.points.front(), high = low;
    for (const Vec3& p : surface.points)
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    surface.middle = 0.5 * (low + high);
    surface.outward = {0, 0, 1};
    return;
  }
  const ScalpelPath& path = cut_->cuts().front()->path();
  const PathFrame middle = path.at(path.length() / 2);
  surface.middle = middle.position;
  surface.along = middle.along;
  constexpr int samples = 20;
  for (int i = 0; i <= samples; ++i) surface.outward += path.at(path.length() * i / samples).outward;
}

std::optional<ReplayOff> MeshScene::replay_off() const {
  if (!simulated_ || !wounds_) return std::nullopt;
  std::vector<Vec3> replayed(surface_->points.size());
  wounds_->positions(duration_, replayed);
  std::vector<const Incision*> cuts;
  for (const auto& cut : cut_->cuts()) cuts.push_back(cut.get());
  return simulated_->off(cuts, replayed, duration_);
}

void MeshScene::positions(double t, std::vector<Vec3>& out) const {
  out.resize(surface_->points.size());
  if (simulated_) return simulated_->positions(t, out);
  if (!wounds_) return void(out = surface_->points);
  wounds_->positions(t, level(), out);
}

std::vector<bool> MeshScene::moving() const {
  std::vector<bool> any(surface_->points.size(), false);
  if (simulated_) {
    for (const SimulatedWounds::Place& place : simulated_->places()) any[place.vertex] = true;
    return any;
  }
  if (!wounds_) return any;
  for (const Replay& replay : level().replays)
    for (const ActiveVertex& a : replay.active()) any[a.vertex] = true;
  return any;
}

std::shared_ptr<const WoundScene> MeshScene::with_detail(double mm) const {
  if (!wounds_ || simulated_) return nullptr;
  auto scene = std::shared_ptr<MeshScene>(new MeshScene(*this));
  scene->level_ = std::make_shared<const ReplayedWounds::Level>(wounds_->level(mm));
  return scene;
}

std::optional<LeftOut> MeshScene::left_out() const {
  if (!wounds_ || simulated_) return std::nullopt;
  return LeftOut{level().left_out(), level().left_out() + level().active(), level().error};
}

std::vector<Validity> MeshScene::validity() const {
  if (!wounds_ || simulated_) return {};
  return wounds_->validity(fields_->turning());
}

std::vector<WoundScene::Opening> MeshScene::openings(double t) const {
  std::vector<Vec3> moved;
  positions(t, moved);
  std::vector<Opening> all;
  for (const auto& cut : cut_->cuts()) {
    Opening& opening = all.emplace_back();
    for (const auto& place : cut->chain()) {
      opening.places.push_back(place.s);
      opening.values.push_back(
          norm(moved[static_cast<std::size_t>(place.right)] - moved[static_cast<std::size_t>(place.left)]));
    }
  }
  return all;
}

std::vector<WoundFigures> MeshScene::wound_figures(double t) const {
  std::vector<Vec3> moved;
  positions(t, moved);
  return cleft::wound_figures(cut_->mesh(), cut_->cuts(), moved);
}

/// The displacement, or how far the replay is from it. What needs derivatives of a field is not known.
void MeshScene::simulated_values(const Coloring& coloring, double t, std::vector<double>& out) const {
  std::vector<Vec3> moved(out.size()), replayed = surface_->points;
  simulated_->positions(t, moved);
  if (coloring == Coloring::error && wounds_) wounds_->positions(t, replayed);
  if (coloring != Coloring::displacement && coloring != Coloring::error) return;
  for (std::size_t v = 0; v < out.size(); ++v) out[v] = norm(moved[v] - replayed[v]);
}

void MeshScene::values(const Coloring& coloring, const Field* reference, double t,
                       std::vector<double>& out) const {
  out.assign(surface_->points.size(), 0);
  if (is_look(coloring)) return;
  if (simulated_) return simulated_values(coloring, t, out);
  if (!wounds_) return;
  const Wounds::Blade now = wounds_->blade(t);
  for (std::size_t k = 0; k <= now.cut; ++k) {
    const VaryingField& field = (*wounds_)[k].field;
    const double s = k == now.cut ? now.s : (*wounds_)[k].complete();
    for (const ActiveVertex& a : wounds_->active(k)) {
      const Place place{a.uvw, a.side_at(s), a.time_at(s, field.shape().cut().length)};
      double& value = out[a.vertex];
      const double here =
          a.weight * wounds_->amplitude(k, a.s, now) * color_value(coloring, field, reference, place, a.s);
      if (is_signed(coloring) ? std::abs(here) > std::abs(value) : here > value) value = here;
    }
  }
}

}  // namespace cleft
