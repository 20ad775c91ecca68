// The interface of what a view draws: a surface whose points depend on the length cut. Without VTK.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/scene/coloring.h"
#include "explorer/wound/detail.h"
#include "explorer/wound/validity.h"
#include "explorer/wound/wound_figures.h"
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
  virtual void values(const Coloring& coloring, const Field* reference, double t,
                      std::vector<double>& out) const = 0;

  /// Of each cut that is replayed, what is known of its opening's error; empty where none is.
  virtual std::vector<Validity> validity() const { return {}; }

  /// The distance from lip to lip along a cut, mm, at the places of its path, mm.
  struct Opening {
    std::vector<double> places, values;
  };
  /// Of each cut in a mesh at t.
  virtual std::vector<Opening> openings(double) const { return {}; }
  virtual std::vector<WoundFigures> wound_figures(double) const { return {}; }  ///< likewise
};

}  // namespace cleft
