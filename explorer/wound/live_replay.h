// The wound while it is being cut: vertices enter when the blade comes near, each contracted once, and are
// left alone when they have come to rest. What a step costs goes with what the cut has changed, and a frame
// with the vertices that move. Positions are those of a Replay of the same incision, bit for bit.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "explorer/wound/contractor.h"
#include "explorer/wound/wound.h"

namespace cleft {

class LiveReplay {
 public:
  /// The wound, whose field's displacements at t = 0 must be 0, must outlive it; its volume follows the
  /// incision here. Of vertices that enter together no more than `most_entering` do so at once, the others at
  /// the next calls: so long they stay at rest.
  explicit LiveReplay(Wound& wound, std::size_t most_entering = std::numeric_limits<std::size_t>::max());

  /// To be called after every advance_to, lead_on, undo and redo of the incision, and of later ones in its
  /// mesh. Where the path was led on, vertices stay where they were taken to lie until that was wrong by
  /// `misplaced`.
  void follow();
  /// The blade is at s mm of the path.
  void move_to(double s);

  /// Of a vertex of the incision's mesh, mesh units.
  const Vec3& position(int vertex) const { return position_[static_cast<std::size_t>(vertex) + 1]; }
  Vec3 displacement(int vertex) const {
    return position(vertex) - rest_[static_cast<std::size_t>(vertex) + 1];
  }
  std::size_t vertex_count() const { return rest_.size() - 1; }

  /// Where along the path a vertex that has entered lies, mm.
  double station(int vertex) const { return stations_[static_cast<std::size_t>(vertex) + 1]; }
  /// All that have entered and are still there.
  std::vector<int> entered() const;

  /// The vertices whose positions the last follow() or move_to() has computed, some perhaps twice.
  const std::vector<int>& touched() const { return touched_; }
  std::size_t active() const { return active_; }          ///< vertices that have entered
  std::size_t late() const { return late_.size(); }       ///< that should have
  std::size_t contracted() const { return contracted_; }  ///< in the last follow()

 private:
  /// Vertices that entered together.
  struct Batch {
    ReplayPieces pieces;
    std::size_t left;  ///< that are still in it
  };
  struct Slot {
    int batch = -1, index = 0;
    std::uint32_t version = 0;  ///< of its place: what waits for an older one is forgotten
  };
  /// Where a vertex was taken to lie.
  struct Placed {
    bool anywhere = false;
    Side side = Side::both;
    double s = 0, across = 0;  // mm
    Vec3 along;
  };
  /// A vertex is placed anew where its place was wrong by so many mm, or T by so many radians. Over a quarter
  /// of a millimetre a wound's displacements change by some hundredths of one; to place every vertex anew
  /// with every piece of the path would contract the field for each of them many times.
  static constexpr double misplaced = 0.25, turned = 0.1;
  struct Waiting {
    double enters;  ///< mm of the path
    int vertex;
    std::uint32_t version;
    bool operator<(const Waiting& other) const { return enters > other.enters; }
  };

  std::vector<int> changed_vertices();
  void follow_path(const std::vector<int>& changed);
  void leave(int vertex);
  void place(int vertex);
  void take_place(int vertex, const std::optional<ActiveVertex>& at);
  void enter();
  void shrink(std::size_t vertices);

  const Incision& incision_;
  IncisionVolume& volume_;
  double blade_ = 0, led_ = 0;
  std::size_t most_entering_;
  bool undone_ = false;
  Contractor contractor_;
  std::vector<Vec3> rest_, position_;  // number 0 is nobody's: it takes what is computed for those that left
  std::vector<Slot> slots_;
  std::vector<double> stations_;
  std::vector<Placed> placed_;  // of a path that is led on
  std::vector<Batch> batches_;
  std::priority_queue<Waiting> waiting_;
  std::deque<Waiting> late_;
  std::vector<ActiveVertex> entering_;
  std::vector<int> chain_end_;  // vertices of the chain's end as of the last follow()
  std::vector<int> touched_;
  std::size_t active_ = 0, contracted_ = 0;
};

}  // namespace cleft
