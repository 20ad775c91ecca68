// A case's wound in a surface mesh.
#pragma once

#include <memory>

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"
#include "explorer/scene/replay.h"
#include "explorer/view/wound_scene.h"

namespace cleft {

class MeshScene : public WoundScene {
 public:
  /// `incision` is cut to its end, in mm, through a mesh of that many points.
  MeshScene(std::shared_ptr<const Incision> incision, const Field& field, int original_points);

  const WoundSurface& surface() const override { return surface_; }
  double duration() const override { return replay_.path_length(); }
  void positions(double t, std::vector<Vec3>& out) const override;
  bool shows_displacement() const override { return false; }

 private:
  std::shared_ptr<const Incision> incision_;
  Replay replay_;
  WoundSurface surface_;
};

}  // namespace cleft
