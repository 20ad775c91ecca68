// The ladder of knots: nested knot vectors in normalised parameters. Each case chooses its rung separately,
// and knot insertion raises cases to common knots.
#pragma once

#include <array>
#include <vector>

#include "encoder/field/bspline.h"
#include "encoder/field/parametrization.h"
#include "encoder/front_kinks.h"

namespace cleft {

/// Numbers of spans. A parametrisation that follows the tip has spans before the start of the cut, along it
/// and ahead of its tip; on each side of v = 0; above and below the bottom of the cut; in time. A fixed one
/// has no spans before, after and below.
struct Rung {
  int before = 1, along = 1, after = 1, across = 1, above = 1, below = 1, time = 1;
  std::vector<TimeKink> kinks = {};  ///< ascending; of a parametrisation that follows the tip
  bool waits = false;                ///< whether knots ahead of the tip serve what happens far from it
  bool bends = false;                ///< whether knots in the middle of the cut come early
  bool winds = false;                ///< whether all of its sixteenths come before what is next to the ends
  bool close = false;                ///< whether knots beside the cut come as close as nodes of coarse meshes

  friend bool operator==(const Rung&, const Rung&) = default;
};

inline constexpr int most_time_spans = 32;

/// Bases over along, across, height and time. A rung with at least as many spans in each number contains all
/// knots of the other rung. A parametrisation that follows the tip has dense knots near tip, start, plane and
/// bottom of the cut; it has none beyond a start or end at the edge of the patch, or a bottom at the bottom
/// of the patch. Without a cut (length 0) `across` has no break. `frames` (more than 1) bounds degree and
/// spans in time.
std::array<BSplineBasis, 4> bases_of(const Rung& rung, const Parametrization& parametrization, int frames);

/// Numbers of spans of bases whose knots are at even distances, mm, whatever the cut does: before its start,
/// along it and beyond its end; on each side of v = 0 (without a cut: in all); above and below its bottom; in
/// time.
struct EvenSpans {
  int before = 1, along = 1, after = 1, across = 1, above = 1, below = 1, time = 1;
};
/// Over a parametrisation that does not change with time (its tip stands still). Breaks are where those of
/// bases_of(const Rung&, ...) are; spans that its cut does not have are left out.
std::array<BSplineBasis, 4> even_bases(const EvenSpans& spans, const Parametrization& parametrization,
                                       int frames);

/// Rungs of growing size, each contained in the next. The order of refinement that follows the tip comes from
/// trials on a few cuts.
struct LadderOf {
  bool round = false;  ///< the height is an angle around the front, over which the whole body changes
  bool waits = false;  ///< the front waits while others move
  bool bends = false;  ///< the direction of the cut turns, and what opens turns with it
  bool winds = false;  ///< it turns so much that the middle of the cut needs as many knots as its ends
};
std::vector<Rung> ladder_of(const Parametrization& parametrization, const LadderOf& series = {});

/// Rungs of close knots, for a parametrisation that resolves the front: where elements are as large as a
/// third of the cut's depth and more, these need fewer control points than the ladder. Edges must hold the
/// spline between the nodes.
std::vector<Rung> close_rungs_of(const LadderOf& series = {});

}  // namespace cleft
