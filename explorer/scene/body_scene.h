// The body of imported data: the surface of its own mesh, moved and coloured by its field.
#pragma once

#include <memory>

#include "explorer/scene/wound_scene.h"
#include "explorer/study/field_on_mesh.h"

namespace cleft {

class BodyScene : public WoundScene {
 public:
  explicit BodyScene(std::shared_ptr<const FieldOnMesh> field);

  const WoundSurface& surface() const override { return surface_; }
  double duration() const override { return field_->duration(); }
  void positions(double t, std::vector<Vec3>& out) const override;
  /// Of several breaks, gape, strain and difference are NaN.
  void values(const Coloring& coloring, const Field* reference, double t,
              std::vector<double>& out) const override;

 private:
  std::vector<double> quantities(const std::string& name, double t) const;
  std::vector<double> errors(double t) const;

  std::shared_ptr<const FieldOnMesh> field_;
  std::vector<int> nodes_;  ///< of the mesh, one for each point
  WoundSurface surface_;
};

}  // namespace cleft
