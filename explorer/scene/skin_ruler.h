// Distances, an angle and an area between places of a scene's skin, which move with it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/scene/wound_scene.h"

namespace cleft {

/// What lies between places, one after another.
struct Measures {
  std::vector<Vec3> places;
  std::vector<double> distances;  ///< mm, straight, from each to the next
  std::optional<double> angle;    ///< degrees, at the second of three
  std::optional<double> area;     ///< mm2, of the polygon of three or more: half the norm of its vector area
};
Measures measures_of(std::vector<Vec3> places);
/// "12.3 mm (at rest 11.9); angle 80.1 degrees (79); area 50.2 mm2 (48)"
std::string told(const Measures& now, const Measures& rest);

class SkinRuler {
 public:
  /// Each of the places, mm, belongs to the triangle of the skin that is nearest at rest; of several, as on
  /// the line of a cut, to the first. Throws InputError where the skin is more than `farthest` mm away.
  SkinRuler(std::shared_ptr<const WoundScene> scene, std::vector<Vec3> places);

  static constexpr double farthest = 1;

  const std::shared_ptr<const WoundScene>& scene() const { return scene_; }
  const std::vector<Vec3>& places() const { return asked_; }
  Measures at(double t) const;  ///< when the length t is cut
  Measures at_rest() const;

 private:
  struct Attachment {
    std::array<int, 3> corners;
    std::array<double, 3> weights;
  };
  Measures of(const std::vector<Vec3>& points) const;

  std::shared_ptr<const WoundScene> scene_;
  std::vector<Vec3> asked_;
  std::vector<Attachment> attachments_;
};

}  // namespace cleft
