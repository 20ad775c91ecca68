// How much of the sky each point of a surface sees: ambient occlusion, without VTK.
#pragma once

#include <array>
#include <vector>

#include "explorer/scene/wound_scene.h"

namespace cleft {

/// For each point of `triangles` the part of the light of an even sky that reaches it, 0 to 1, weighted by
/// the cosine to its normal; 1 for points without triangles. Found by depth maps of the triangles from up
/// to `sky_directions` directions, fewer of many triangles, each `sky_pixels` wide and high.
std::vector<float> open_sky(const std::vector<Vec3>& points,
                            const std::vector<std::array<int, 3>>& triangles);

inline constexpr int sky_directions = 64, sky_pixels = 256;

/// Light and moisture of a wound's surface. Lengths in mm.
class SurfaceLight {
 public:
  /// Of the skin as it is closed at rest. What `before` knows of the same mesh is taken from it: points that
  /// cuts have added are between their neighbours.
  explicit SurfaceLight(const WoundSurface& surface, const SurfaceLight* before = nullptr);

  static constexpr float far = 5;
  struct Light {
    float open = 1;   ///< part of the sky's light
    float dry = far;  ///< mm from a lip that is apart; `far` where that is farther
    friend bool operator==(const Light&, const Light&) = default;
  };
  /// With the surface's points where they are now. A place d below its lip, at the wall of a slot as wide as
  /// the lips are apart, sees the part 1 - d / sqrt(d^2 + width^2) of what the lip sees (a long slot with
  /// parallel walls).
  void at(const std::vector<Vec3>& points, std::vector<Light>& out) const;

 private:
  void find_lips(const WoundSurface& surface);
  struct Near {
    int point, lip;  // lip: an index into lips_
    double distance;
  };
  std::vector<Near> near_lips(const WoundSurface& surface, bool walls, double most) const;
  bool take_sky(const WoundSurface& surface, const SurfaceLight& before);
  void fill_added(const WoundSurface& surface);

  std::vector<Vec3> original_;  // the points that no cut has added, where `sky_` was found
  std::vector<float> sky_;      // of every point
  struct Lip {
    int point, across;  // across: at the same place at rest
  };
  std::vector<Lip> lips_;
  std::vector<Near> walls_, rims_;  // rims: of skin
};

}  // namespace cleft
