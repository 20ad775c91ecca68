#include "explorer/incision/incision_advance.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision_change.h"
#include "explorer/incision/incision_walk.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

void step_on(IncisionState& cut) {
  const PathStep step = next_step(cut);
  cut.next.reset();
  if (!made_room(cut, step)) take(cut, step);
}

void check_progress(const IncisionState& cut) {
  constexpr std::size_t steps = Limits::stuck_vertices;
  if (cut.chain.size() < steps ||
      cut.tip_s() - cut.chain[cut.chain.size() - steps].s > Limits::stuck_progress * cut.path.length())
    return;
  throw InputError("the path runs along a wound near " + place_of(cut.mesh.position(cut.tip_vertex())) +
                   ", at arc length " + shortest(cut.tip_s()) + "; lead it across, or away from it");
}

}  // namespace

void cut_on_to(IncisionState& cut, double s) {
  s = std::min(s, cut.path.length());
  if (s < cut.tip_s() || (!cut.provisional && (s == cut.tip_s() || cut.tip.left_mesh))) return;
  cut.drop_provisional();
  const double same = Limits::same_s * cut.path.length();
  while (!cut.tip.left_mesh && s - cut.tip_s() > same && next_step(cut).s <= s + same) {
    const IncisionState::Before state = cut.before();
    try {
      step_on(cut);
    } catch (...) {
      cut.roll_back(state);
      throw;
    }
    check_progress(cut);
  }
  if (cut.tip.left_mesh || s - cut.tip_s() <= same) return;

  // The blade stands between two vertices of the path: at one of them if it is close, else at one of its own.
  const PathStep& next = next_step(cut);
  const double close = cut.snap / Limits::path_snap_parts * std::min(next.s - cut.tip_s(), cut.longest_piece);
  if (s - cut.tip_s() <= close) return;
  const PathStep step = next.s - s <= close ? next : shorter(cut, next, s);
  const IncisionState::Before state = cut.before();
  try {
    take(cut, step);
  } catch (...) {
    cut.roll_back(state);
    throw;
  }
  cut.provisional = state;
}

void rehearse(IncisionState& cut) {
  constexpr int most_steps = 6;            // some of them only make triangles smaller
  constexpr std::size_t segment_open = 3;  // vertices of the chain: start, one that opens, tip
  const IncisionState::Before untouched = cut.before();
  const bool bent = cut.bent;
  try {
    for (int k = 0; k < most_steps && cut.chain.size() < segment_open && !cut.tip.left_mesh &&
                    next_step(cut).s <= cut.path.length();
         ++k)
      step_on(cut);
  } catch (const InputError&) {  // for the blade to meet, if it gets there
  }
  cut.roll_back(untouched);
  cut.next.reset();
  cut.bent = bent;
}

}  // namespace cleft
