#include "explorer/scene/live_scene.h"

#include <cmath>

namespace cleft {

LiveScene::LiveScene(std::shared_ptr<const CuttingMoment> moment, const WoundSurface& like,
                     std::shared_ptr<const SurfaceDent> dent)
    : moment_(std::move(moment)), surface_(*moment_->surface), dent_(std::move(dent)) {
  surface_.middle = like.middle, surface_.outward = like.outward, surface_.along = like.along;
}

void LiveScene::positions(double, std::vector<Vec3>& out) const {
  out = moment_->points;
  if (!dent_ || dent_by_ == Vec3{}) return;
  for (Vec3& x : out)
    if (const double square = squared_norm(x - dent_at_); square < dent_reach * dent_reach)
      x += dent_->at(std::sqrt(square)) * dent_by_;
}

void LiveScene::values(const Coloring&, const Field*, double, std::vector<double>& out) const {
  out.assign(surface_.points.size(), 0);
}

void LiveScene::dent(const HapticState& scalpel) {
  dent_at_ = scalpel.proxy;
  dent_by_ = scalpel.phase == Phase::contact ? -scalpel.depth * scalpel.normal : Vec3{};
}

}  // namespace cleft
