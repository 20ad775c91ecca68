// The wounds of a mesh while the newest of them is cut, with its blade at its tip: live replays, superposed.
#pragma once

#include "explorer/wound/live_replay.h"
#include "explorer/wound/wounds.h"

namespace cleft {

class LiveWounds : public Wounds {
 public:
  LiveWounds() = default;

  /// A wound of the newest cut of the mesh. Of its vertices no more than `most_entering` begin to move at
  /// once.
  void add(Wound wound, std::size_t most_entering);
  /// To be called after every change of the mesh: the first `count` wounds, or all, take it in.
  void follow(std::size_t count);
  void follow() { follow(size()); }
  /// The blade of every wound is at its tip.
  void move_to_tips();
  /// The blade of the newest wound is at the end of its path.
  void complete_newest();
  /// Finds how far each opens in the tension that the others leave, where cuts have grown by a millimetre
  /// since the last time, or one is complete: returns whether it did. Where a field does not tell the tension
  /// they add.
  bool relieve();

  /// The displacement of a vertex by all wounds, mm.
  Vec3 displacement(int vertex) const {
    Vec3 sum;
    std::size_t k = 0;
    for (const LiveReplay& replay : replays_)
      sum += scale_ * newest_relief().amplitude(k++, replay.station(vertex), 1) * replay.displacement(vertex);
    return sum;
  }
  /// Every wound's vertices, alone.
  const std::deque<LiveReplay>& replays() const { return replays_; }

 private:
  std::deque<LiveReplay> replays_;
  double scale_ = 1;
  double relieved_at_ = 0;  // mm: the length of all cuts for which their relief was found
};

}  // namespace cleft
