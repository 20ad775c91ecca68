// Where cuts meet, and the place of vertices beside a cut: skin next to there moves with its own piece.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// Depths of the other cut from it, over which leaning lips change sides where cuts cross. Of that, so far
/// from the crossing along a cut its corners are.
constexpr double lean_fades = 0.1, corner_part = 0.5;
/// The part of a path's normal that lies in the other cut's skin: with less the surface has turned away.
constexpr double turned_away = 0.1;

/// Where a cut is crossed by another one, or another one opens into it.
struct Crossing {
  std::size_t cut, other;
  double s;        ///< mm along the cut
  double other_s;  ///< and along the other one
  double fades;   ///< mm: over which the lips of this cut change the side to which they lean; where the other
                  ///< one opens into it, how far from it corners part
  double toward;  ///< 1: with s the cut goes to v > 0 of the other one, or -1
  double branch = 0;  ///< the side of this cut from which the other one opens into it, -1 or 1; 0: they cross
  bool at_end = false;  ///< it opens into it with its end
  double way = 0;       ///< mm along the other one that opens into it: the blade is then `fades` away
  /// Of this cut, where the other one opens into it: 0 at v < 0, 1 at v > 0.
  std::size_t side() const { return branch > 0 ? 1 : 0; }
  /// mm along the cut to either side, in which vertices keep with their own piece.
  double reach() const;
  /// mm along the cut: of the corners before and behind one that opens into it.
  double before() const { return s - corners_apart; }
  double behind() const { return s + corners_apart; }
  static constexpr double corners_apart = 1e-6;
};
/// In order of `cut`.
std::vector<Crossing> crossings_of(const std::vector<const Wound*>& cuts);

/// A vertex beside a cut, as its relief needs it.
struct BesideCut {
  double s = 0;          ///< mm along the path
  double corner_s = 0;   ///< where another cut opens into this one: of the corner to which the vertex belongs
  double corner = 0;     ///< how far it moves with that corner where it is free, 0 to 1
  std::size_t side = 0;  ///< of this cut, on which that is (Crossing::side)
  std::size_t mouth = 0;  ///< which of those that open into this cut, in the order of crossings_of
  Vec3 across;            ///< in the mesh's space, shorter the further from the lips
  Vec3 along, outward;    ///< unit

  BesideCut() = default;
  BesideCut(const ActiveVertex& vertex, const Wound& wound);
  /// Next to where the cut is crossed by others it counts as on that part of the cut which its piece of skin
  /// is beside: corners of a crossing are at one place of each cut. `nearest` is a vertex of that piece.
  void keep_with_own_piece(const ActiveVertex& vertex, int nearest, std::size_t cut,
                           const std::vector<const Wound*>& cuts, std::span<const Crossing> crossings);
};

}  // namespace cleft
