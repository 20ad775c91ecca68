// The incision parametrisation volume: the canonical (u, v, w) of every vertex near a cut, and the frame in
// which its canonical displacement is applied. Paper, section 3.5.
//
// u runs with the path's arc length; a path longer than the canonical cut keeps its first and last half, and
// between them the steady state of the middle. v is the distance from the path over the skin, measured across
// it. w is 0 on the skin; the walls reach from there to the canonical depth, independent of their own depth,
// along the blade; if the blade is tilted, displacements are still in the skin's frame (T, across, the skin's
// normal along the cut). The side of a vertex follows from the surface (the lip from which it is reached
// first), never from space: a vertex opposite the cut but far along the surface does not move.
//
// Where the path bends tighter than the patch is wide, or comes back to itself, and where the skin folds, the
// coordinates jump from one vertex to the next: displacements that would jump with them decrease to zero
// before (room.h). The coordinates of a vertex depend on its side of the wound, not on the position of the
// blade.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"
#include "explorer/wound/room.h"

namespace cleft {

/// How far a cut has opened with the blade at a place of it, mm: so far; one that ends in the wound of an
/// earlier one runs on beyond its end when the blade arrives there.
struct OpenedTo {
  double end = 0, runs_on = 0;            ///< where it comes to the other; how far beyond
  static constexpr double arrives = 0.1;  ///< of that: the last of the blade's way, in which it does
  double begins() const { return end - arrives * runs_on; }
  double beyond(double blade) const { return std::clamp((blade - end) / arrives + runs_on, 0., runs_on); }
  double operator()(double blade) const { return runs_on > 0 ? std::min(blade, end) + beyond(blade) : blade; }
};

struct ActiveVertex {
  int vertex = 0;
  Vec3 uvw;                     ///< canonical, mm, inside the field's patch
  Side side = Side::both;       ///< never against the sign of v
  Vec3 along, across, outward;  ///< unit vectors in the mesh's space: T of the path, across it, skin's normal
  double s = 0;                 ///< mm along the path
  double time_offset = 0;  ///< tau: with the blade at p the field's time is clamp(p + tau, 0, cut length)
  double weight =
      1;  ///< 1 in the patch, falling to 0 over a quarter of its width outside it; less in little room
  bool on_cut = false;  ///< a vertex of lips or walls: closed (Side::both) until the blade passes s
  OpenedTo opened_to = {};

  /// With the blade at `blade`, mm: whether it has passed, the side, and the time of a field of a cut so
  /// long.
  bool is_passed(double blade) const { return s < opened_to(blade); }
  Side side_at(double blade) const { return on_cut && !is_passed(blade) ? Side::both : side; }
  double time_at(double blade, double cut_length) const {
    return std::clamp(opened_to(blade) + time_offset, 0., cut_length);
  }
  /// A canonical displacement here, weighted, in the directions of the mesh's space; in the same unit.
  Vec3 in_mesh(const Vec3& d) const { return weight * (d.x * along + d.y * across + d.z * outward); }
};

/// IncisionOptions::reach that a field needs, in mesh units. `scale` is mm per mesh unit, here and below.
double reach_of(const Field& field, double scale);

class IncisionVolume {
 public:
  /// The incision and the field must outlive it.
  IncisionVolume(const Incision& incision, const VaryingField& field, double scale);

  /// The field that opens the cut, where it is another than that of the constructor, of the same shape. A
  /// family's tells the directions of frames.
  void opened_by(const VaryingField& field);

  /// Where the cut opens into the wound of an earlier one.
  struct Mouth {
    const Incision* earlier;
    double s;         ///< mm along the path, where it comes to that one
    double opens_on;  ///< mm: from there, so far as there; at its end, so far beyond
    bool right;       ///< the cut lies at v > 0 of the earlier one
    /// 1 in the skin of this side, 0 beyond the other cut, and between around its ends.
    double part(const Vec3& place, Side beside, double scale) const;
  };
  /// The cut begins, or ends, in the wound of an earlier one, which must outlive it: next to there it opens
  /// on.
  void opens_into(const Incision& earlier, bool at_end);
  const std::optional<Mouth>& mouth(bool at_end) const { return mouths_[at_end]; }
  double opens_on(bool at_end) const { return mouths_[at_end] ? mouths_[at_end]->opens_on : 0; }
  /// The place on the canonical cut of s mm of the path, of `length` mm, on a lip.
  CanonicalPlace canonical(double s, double length) const {
    const double opens_to = mouths_[1] ? mouths_[1]->s + mouths_[1]->opens_on : length;
    return canonical_place(s, opens_to, field_.cut(), opens_on(false));
  }
  OpenedTo opened_to() const {
    if (!mouths_[1] || stops_before_mouth()) return {};
    return {mouths_[1]->s, mouths_[1]->opens_on};
  }

  /// Must be called after each change of the mesh with the vertices of changed triangles and new vertices,
  /// sorted.
  void update(const std::vector<int>& vertices);
  /// Must be called when the incision's path was extended, before the update of vertices: the surroundings'
  /// relabelled() have new labels.
  void follow_path();

  /// The coordinates of a vertex, if the field reaches it.
  std::optional<ActiveVertex> locate(int vertex) const;

  /// The coordinates of a place `depth` mm below the skin, where `nearest` is the nearest vertex of the skin.
  /// `side`: the side of the cut's surface for a place on it; elsewhere `both`. Its `vertex` is -1.
  /// Likewise `beside`, of the cuts that it begins and ends in.
  std::optional<ActiveVertex> locate_below(const Vec3& place, double depth, int nearest, Side side,
                                           std::array<Side, 2> beside = {Side::both, Side::both}) const;

  /// The part of the field's displacement that a lip does not take at s of the path, because the path bends
  /// or comes back, or the skin folds, too near to it.
  double part_held_back(double s, Side side) const;

  /// The frame at s, mesh units: the skin's mean normal, and T of the path perpendicular to it.
  PathFrame skin_frame(double s) const;
  double scale() const { return scale_; }
  /// All vertices that the field can move, in the order of their numbers. update() must know all of them.
  std::vector<ActiveVertex> active() const;

 private:
  struct Place {
    Vec3 place;           // mesh units
    double s, across, w;  // s and across in mesh units, w in mm
    Side side;
    bool on_cut;
    double straight;             // distance from the path, mesh units, on the side of v
    std::array<Side, 2> beside;  // if it is on the surface of a cut that this one begins or ends in
  };
  std::optional<Place> place_of(int vertex) const;
  bool stops_before_mouth() const;
  std::array<Side, 2> beside_ends(const CutMesh::Vertex& vertex) const;
  std::optional<ActiveVertex> activate(int vertex, const Place& at) const;
  struct WoundSide {
    Side side;
    bool on_wall;
  };
  WoundSide side_of_wound(int vertex) const;
  Side side_on_skin(int vertex, double straight) const;
  void find_normals();
  void find_directions();
  void find_tilts();
  std::pair<std::size_t, double> place_along(double s) const;
  PathFrame frame_along(double s, const std::optional<Vec3>& along) const;
  double lift_of_tilted_blade(double s, double v) const;
  CanonicalPlace canonical(const Place& at) const;

  const Incision& incision_;
  const Field& field_;
  double scale_, margin_;
  std::optional<VaryingField> family_;       // displaces along its own directions, and lifts a tilted blade
  std::vector<Surroundings::Label> labels_;  // of vertices that came later, too
  WoundRoom room_;
  std::array<std::optional<Mouth>, 2> mouths_;  // at its start and its end
  std::vector<Vec3> along_;                     // T at even distances along the path, means
  std::vector<double> tilt_;     // there, of the blade against the skin's normal, radians, means
  std::vector<double> station_;  // s of the surroundings' stations
  std::vector<Vec3> normal_;     // of the skin there, a mean
};

}  // namespace cleft
