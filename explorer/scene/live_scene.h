// The scene while a scalpel cuts: the current mesh, and the skin dented under the blade.
#pragma once

#include <memory>
#include <optional>

#include "explorer/scalpel/cutting_moment.h"
#include "explorer/scene/wound_scene.h"
#include "haptic/surface_dent.h"

namespace cleft {

class LiveScene : public WoundScene {
 public:
  /// Shown as `like`, a scene of the same mesh; without a `dent` the skin does not sink. Lengths in mm.
  LiveScene(std::shared_ptr<const CuttingMoment> moment, const WoundSurface& like,
            std::shared_ptr<const SurfaceDent> dent = nullptr);

  const WoundSurface& surface() const override { return surface_; }
  double duration() const override { return moment_->cut_length; }
  /// The current points, whatever t is.
  void positions(double t, std::vector<Vec3>& out) const override;
  void values(const Coloring& coloring, const Field* reference, double t,
              std::vector<double>& out) const override;

  /// Whether the current state can be drawn without a new scene.
  bool has_surface_of(const CuttingMoment& moment) const { return moment.surface == moment_->surface; }
  void show(std::shared_ptr<const CuttingMoment> moment) { moment_ = std::move(moment); }
  /// Before puncture the skin sinks with the tip, by the force divided by its stiffness.
  void dent(const HapticState& scalpel);

 private:
  std::shared_ptr<const CuttingMoment> moment_;
  WoundSurface surface_;
  std::shared_ptr<const SurfaceDent> dent_;
  Vec3 dent_at_, dent_by_;  // mm
};

}  // namespace cleft
