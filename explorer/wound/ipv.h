// The incision parametrisation volume: the canonical (u, v, w) of every vertex near a cut, and the frame in
// which a canonical displacement comes back. Paper, section 3.5.
//
// u runs with the path's arc length; a path longer than the canonical cut keeps its first and last half, and
// between them the steady state of the middle. v is the distance from the path over the skin, measured across
// it. w is 0 on the skin; the walls reach from there to the canonical depth, whatever their own, along the
// blade; where that is tilted, displacements are still those of the skin's own frame (T, across, the skin's
// normal along the cut). On which side a vertex lies is told by the surface, from which lip it is reached
// first, never by space: a vertex that lies opposite the cut but far along the surface takes no part.
//
// Where the path bends tighter than the patch is wide, the nearest place of the path jumps: displacements
// fall to nothing before.
//
// Where a vertex lies does not depend on how far the blade has come, only on which side of the wound it is.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"

namespace cleft {

struct ActiveVertex {
  int vertex = 0;
  Vec3 uvw;                     ///< canonical, mm, inside the field's patch
  Side side = Side::both;       ///< never against the sign of v
  Vec3 along, across, outward;  ///< unit vectors in the mesh's space: T of the path, across it, skin's normal
  double s = 0;                 ///< mm along the path
  double time_offset = 0;  ///< tau: with the blade at p the field's time is clamp(p + tau, 0, cut length)
  double weight =
      1;  ///< 1 in the patch, falling to 0 over a quarter of its width beside it, and inside bends
  bool on_cut = false;  ///< a vertex of lips or walls: closed (Side::both) until the blade passes s

  /// A canonical displacement here, weighted, in the directions of the mesh's space; in the same unit.
  Vec3 in_mesh(const Vec3& d) const { return weight * (d.x * along + d.y * across + d.z * outward); }
};

/// Where the place s of a path of length `length` (all mm) lies on the canonical cut.
struct CanonicalPlace {
  double u, time_offset;
};
CanonicalPlace canonical_place(double s, double length, const CanonicalCut& cut);

/// IncisionOptions::reach that a field needs, in mesh units. `scale` is mm per mesh unit, here and below.
double reach_of(const Field& field, double scale);

class IncisionVolume {
 public:
  /// The incision and the field must outlive it.
  IncisionVolume(const Incision& incision, const Field& field, double scale);

  /// To be told of the vertices of changed triangles, and of those that are new, sorted, after every change
  /// of the mesh.
  void take_in(const std::vector<int>& vertices);
  /// To be told when the incision's path was led on, before take_in(): the surroundings' relabelled() lie
  /// elsewhere.
  void follow_path();

  /// Where a vertex lies, if the field reaches it.
  std::optional<ActiveVertex> locate(int vertex) const;

  /// Where a place below the skin lies: `depth` mm under it, nearest to a vertex of it. `side` tells on which
  /// side of the cut's surface a place on it is; elsewhere `both`. Its `vertex` is -1.
  std::optional<ActiveVertex> locate_below(const Vec3& place, double depth, int nearest, Side side) const;

  /// At s, mesh units: T of the path made perpendicular to the skin's mean normal there, and that.
  PathFrame skin_frame(double s) const;
  double scale() const { return scale_; }
  /// All vertices that the field can move, in the order of their numbers. take_in() must know all of them.
  std::vector<ActiveVertex> active() const;

 private:
  struct Place {
    double s, across, w;  // s and across in mesh units, w in mm
    Side side;
    bool on_cut;
    double straight;  // distance from the path, mesh units, on the side of v
  };
  std::optional<Place> place_of(int vertex) const;
  double across(double straight, double detour, Side side) const;
  std::optional<ActiveVertex> activate(int vertex, const Place& at) const;
  struct WoundSide {
    Side side;
    bool on_wall;
  };
  WoundSide side_of_wound(int vertex) const;
  void find_normals();
  void find_room();
  double inside_bend(double s, double straight) const;
  double lift_of_tilted_blade(const Vec3& blade, const PathFrame& skin, double v) const;

  const Incision& incision_;
  const Field& field_;
  double scale_, margin_;
  std::vector<Surroundings::Label> labels_;  // of vertices that came later, too
  std::array<std::vector<double>, 2> room_;  // beside the path, left and right, at even distances along it
  std::vector<double> station_;              // s of the surroundings' stations
  std::vector<Vec3> normal_;                 // of the skin there, a mean
};

}  // namespace cleft
