// What a view draws: a surface whose points depend on the length cut. Knows nothing of VTK.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "explorer/incision/cut_mesh.h"
#include "explorer/scene/coloring.h"
#include "explorer/scene/detail.h"

namespace cleft {

/// A surface with an incision, fully cut; at t = 0 its lips lie on each other. Lengths in mm.
struct WoundSurface {
  std::vector<Vec3> points;                       ///< at rest
  std::vector<std::array<int, 3>> triangles;      ///< counter-clockwise seen from outside
  std::vector<Region> regions;                    ///< one for each triangle
  std::vector<double> depth_fraction;             ///< one for each point: 0 at the skin, 1 at the bottom
  int original_points = 0;                        ///< the points from this number on were added by the cut
  Vec3 middle, outward{0, 0, 1}, along{1, 0, 0};  ///< of the cut, for the camera
};

class WoundScene {
 public:
  virtual ~WoundScene() = default;

  virtual const WoundSurface& surface() const = 0;
  virtual double duration() const = 0;  ///< t of the end, mm cut

  /// The points when the length t is cut; always from the rest positions, so that nothing accumulates.
  virtual void positions(double t, std::vector<Vec3>& out) const = 0;

  /// Which points can ever be elsewhere than at rest; empty: any may.
  virtual std::vector<bool> moving() const { return {}; }

  /// The same surface() in which points that never move by more than `mm` stay at rest, and all others move
  /// bit for bit as here; null where it cannot be told which.
  virtual std::shared_ptr<const WoundScene> with_detail(double) const { return nullptr; }
  virtual std::optional<LeftOut> left_out() const { return {}; }  ///< likewise

  /// The value of every point at t by which it is coloured; of `difference`, against `reference`.
  virtual void values(Coloring coloring, const Field* reference, double t,
                      std::vector<double>& out) const = 0;

  /// Where the opening of a cut may be off by more than a tenth, and why: a sentence each.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace cleft
