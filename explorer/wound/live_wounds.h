// The wounds of a mesh while the newest of them is cut, with its blade at its tip: live replays, superposed.
#pragma once

#include "explorer/wound/cut_fields.h"
#include "explorer/wound/live_replay.h"
#include "explorer/wound/wounds.h"

namespace cleft {

class LiveWounds : public Wounds {
 public:
  LiveWounds() = default;

  /// Adds a wound of the newest cut of the mesh. At most `most_entering` of its vertices begin to move at
  /// once.
  void add(Wound wound, std::size_t most_entering);
  /// Must be called after each change of the mesh: updates the first `count` wounds, or all.
  void follow(std::size_t count);
  void follow() { follow(size()); }
  /// The fields of the newest wound follow the shape of its path, to where it was at the last follow().
  void follow_shape(const CutFields& fields) {
    if (!empty()) fields.follow_shape(newest());
  }
  /// Opens the newest cut, whose path has ended (Incision::end_path), as one whose path was known before.
  /// `most_entering`: as in add().
  void reopen_newest(Wound wound, std::size_t most_entering);
  /// Whether vertices wait to enter.
  bool are_entering() const;
  /// Moves the blade of each wound to its tip.
  void move_to_tips();
  /// Moves the blade of the newest wound to the end of its path.
  void complete_newest();
  /// Updates the mutual relief if cuts have grown by a millimetre since the last update, or one is complete;
  /// returns whether it did. If a field lacks the tension, the displacements add.
  bool relieve();

  /// Whether cuts have grown since the guard was found last, and no vertex waits to enter. It is found when
  /// the newest cut is complete: until then all that this cut has changed moves without a guard, and the rest
  /// with that of the earlier cuts.
  bool wants_guard() const;
  /// The guard of all cuts as they are. May be called on another thread, as long as nothing changes here;
  /// `poll` is called all the while, and what it throws ends the search.
  Guard find_guard(const std::function<void()>& poll) const;
  void take_guard(Guard guard);
  /// Finds and takes it if it is wanted; returns whether it was.
  bool guard_skin();

  /// The displacement of a vertex by all wounds, mm.
  Vec3 displacement(int vertex) const {
    const auto own = [this](int v) { return without_guard(v); };
    return guard().empty() ? own(vertex) : guard().displacement(vertex, own);
  }
  /// The vertices of each wound.
  const std::vector<LiveReplay>& replays() const { return replays_; }

 private:
  double length() const;  ///< mm, of all cuts
  void cross(std::size_t count);
  Vec3 without_guard(int vertex) const {
    Vec3 sum;
    std::size_t k = 0;
    for (const LiveReplay& replay : replays_)
      sum += scale_ * now_.relieved(k++, replay.beside(vertex), replay.displacement(vertex));
    return sum;
  }
  std::vector<LiveReplay> replays_;
  Relief::At now_;  // with the blade of the newest wound at its tip
  double scale_ = 1;
  double guarded_at_ = 0;   // mm, likewise, for the guard
  double relieved_at_ = 0;  // mm: the length of all cuts for which their relief was found
};

}  // namespace cleft
