// The canonical patch of a case: its skin and the walls of its cut, sampled from the field.
#pragma once

#include <map>
#include <memory>

#include "encoder/field/field.h"
#include "explorer/scene/wound_scene.h"
#include "explorer/study/raw_case.h"

namespace cleft {

class PatchScene : public WoundScene {
 public:
  /// The skin is a grid over the field's (u, v), finest at the cut and divided along it; the walls extend to
  /// the depth of the cut. `raw`: the simulation for colouring by the error; null: none.
  explicit PatchScene(std::shared_ptr<const Field> field, std::shared_ptr<const RawCase> raw = nullptr);

  const WoundSurface& surface() const override { return surface_; }
  double duration() const override { return field_.duration(); }
  void positions(double t, std::vector<Vec3>& out) const override;
  void values(const Coloring& coloring, const Field* reference, double t,
              std::vector<double>& out) const override;

 private:
  void add_skin(const std::vector<double>& us, const std::vector<double>& vs);
  void add_walls(const std::vector<double>& us);
  int add_point(const Vec3& uvw, Side side);
  void add_quad(int a, int b, int c, int d, Region region);
  bool inside_cut(double u) const;
  Place place(std::size_t point, double t) const;
  void displacements(double t, std::vector<Vec3>& out) const;

  /// The error at the node nearest to each point, mm; NaN without a simulation.
  void errors(double t, std::vector<double>& out) const;

  std::shared_ptr<const Field> shared_;
  std::shared_ptr<const RawCase> raw_;
  mutable std::vector<int> nearest_;                           // node of every point, computed on request
  mutable std::map<std::size_t, std::vector<double>> errors_;  // of every point, by frame
  const Field& field_;
  WoundSurface surface_;
  std::vector<Side> sides_;        ///< of every point
  std::vector<int> left_, right_;  ///< the lips' points by column of the grid; the same where uncut
};

}  // namespace cleft
