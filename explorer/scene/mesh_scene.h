// A case's wounds in a surface mesh.
#pragma once

#include <memory>
#include <optional>

#include "explorer/body/simulated_wounds.h"
#include "explorer/incision/cut_surface.h"
#include "explorer/scene/wound_scene.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/replayed_wounds.h"

namespace cleft {

/// The blade makes the cuts one after another: t runs over the lengths of all of them.
class MeshScene : public WoundScene {
 public:
  /// Without fields the cuts stay closed. Throws InputError if the fields lack the parameters for the mutual
  /// relief of several cuts.
  /// `simulated`: moves the vertices in place of the fields; null: fields do.
  MeshScene(std::shared_ptr<const CutSurface> cut, const std::optional<CutFields>& fields,
            std::shared_ptr<const SimulatedWounds> simulated = nullptr);

  /// How far the fields' replay of the complete cuts is from the simulation; none without both.
  std::optional<ReplayOff> replay_off() const;

  const WoundSurface& surface() const override { return *surface_; }
  double duration() const override { return duration_; }
  void positions(double t, std::vector<Vec3>& out) const override;
  std::vector<bool> moving() const override;
  std::shared_ptr<const WoundScene> with_detail(double mm) const override;
  std::optional<LeftOut> left_out() const override;
  void values(const Coloring& coloring, const Field* reference, double t,
              std::vector<double>& out) const override;
  std::vector<Validity> validity() const override;
  std::vector<Opening> openings(double t) const override;
  std::vector<WoundFigures> wound_figures(double t) const override;

 private:
  MeshScene(const MeshScene&) = default;
  const ReplayedWounds::Level& level() const { return level_ ? *level_ : wounds_->whole(); }
  void simulated_values(const Coloring& coloring, double t, std::vector<double>& out) const;
  void aim_at_cuts(WoundSurface& surface) const;

  std::shared_ptr<const CutSurface> cut_;
  std::optional<CutFields> fields_;
  std::shared_ptr<const SimulatedWounds> simulated_;    // none: fields move the vertices
  std::shared_ptr<const ReplayedWounds> wounds_;        // none without fields or cuts
  std::shared_ptr<const ReplayedWounds::Level> level_;  // none: whole
  double duration_ = 0;
  std::shared_ptr<const WoundSurface> surface_;
};

}  // namespace cleft
