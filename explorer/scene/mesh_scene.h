// A case's wounds in a surface mesh.
#pragma once

#include <memory>

#include "encoder/field/field.h"
#include "explorer/scene/cut_surface.h"
#include "explorer/scene/replay.h"
#include "explorer/scene/wound_scene.h"

namespace cleft {

/// The blade makes the cuts one after another: t runs over the lengths of all of them.
class MeshScene : public WoundScene {
 public:
  /// Without a field the cuts stay closed.
  MeshScene(std::shared_ptr<const CutSurface> cut, std::shared_ptr<const Field> field);

  const WoundSurface& surface() const override { return surface_; }
  double duration() const override { return duration_; }
  void positions(double t, std::vector<Vec3>& out) const override;
  void values(Coloring coloring, const Field* reference, double t, std::vector<double>& out) const override;

 private:
  void aim_at_cuts();

  std::shared_ptr<const CutSurface> cut_;
  std::shared_ptr<const Field> field_;
  std::vector<Replay> replays_;
  double duration_ = 0;
  WoundSurface surface_;
  mutable std::vector<Vec3> moved_;  // by one of several cuts
};

}  // namespace cleft
