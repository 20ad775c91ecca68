// The interface of what a view draws: a surface whose points depend on the length cut. Without VTK.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/scene/coloring.h"
#include "explorer/wound/detail.h"
#include "explorer/wound/wound_surface.h"

namespace cleft {

class WoundScene {
 public:
  virtual ~WoundScene() = default;

  virtual const WoundSurface& surface() const = 0;
  virtual double duration() const = 0;  ///< t of the end, mm cut

  /// The points when the length t is cut; always from the rest positions, so that nothing accumulates.
  virtual void positions(double t, std::vector<Vec3>& out) const = 0;

  /// Which points can move; empty: all.
  virtual std::vector<bool> moving() const { return {}; }

  /// The same surface() in which points that never move by more than `mm` stay at rest, and all others move
  /// bit for bit as here; null if the scene has no bounds of motions.
  virtual std::shared_ptr<const WoundScene> with_detail(double) const { return nullptr; }
  virtual std::optional<LeftOut> left_out() const { return {}; }  ///< likewise

  /// The value of every point at t by which it is coloured; of `difference`, against `reference`.
  virtual void values(Coloring coloring, const Field* reference, double t,
                      std::vector<double>& out) const = 0;

  /// Warnings where the error of a cut's opening may exceed a tenth: one sentence each.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace cleft
