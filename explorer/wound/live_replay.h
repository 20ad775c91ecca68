// The wound while it is being cut: vertices enter when the blade comes near, are contracted once, and are not
// evaluated once they are at rest. The cost of a step is proportional to the change of the cut, that of a
// frame to the number of moving vertices. Positions are those of a Replay of the same incision, bit for bit.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "explorer/wound/contractor.h"
#include "explorer/wound/mutual_relief.h"
#include "explorer/wound/wound.h"

namespace cleft {

class LiveReplay {
 public:
  /// The wound, whose field's displacements at t = 0 must be 0, must outlive it; its volume follows the
  /// incision here. Of vertices that enter together at most `most_entering` do so at once, the others at the
  /// next calls; until then they are at rest.
  explicit LiveReplay(Wound& wound, std::size_t most_entering = std::numeric_limits<std::size_t>::max());

  /// Must be called after every change of the incision, and of later ones in its mesh. If the path was
  /// extended, vertices keep their coordinates until these are wrong by `misplaced`, and the field of the
  /// shape ahead until the shape beside them is known.
  void follow();
  /// The blade is at s mm of the path.
  void move_to(double s);

  /// The position of a vertex of the incision's mesh, mesh units.
  const Vec3& position(int vertex) const { return position_[static_cast<std::size_t>(vertex) + 1]; }
  Vec3 displacement(int vertex) const {
    return position(vertex) - rest_[static_cast<std::size_t>(vertex) + 1];
  }
  std::size_t vertex_count() const { return rest_.size() - 1; }

  /// The displacements, mesh units, with the blade at s of those that have entered.
  void displacements(double s, std::vector<std::pair<int, Vec3>>& out) const;
  /// That of one of them; displacements() may round it otherwise.
  Vec3 displacement(int vertex, double s) const {
    const Slot& slot = slots_[static_cast<std::size_t>(vertex) + 1];
    return batches_[slot.batch].pieces.displacement(static_cast<std::size_t>(slot.index),
                                                    volume_.opened_to()(s));
  }

  /// The place of a vertex that has entered.
  const BesideCut& beside(int vertex) const { return beside_[static_cast<std::size_t>(vertex) + 1]; }
  /// Where complete cuts meet, of which this one is number `cut`: vertices next to it keep with their own
  /// piece of skin (BesideCut), those that enter later too. The cuts must outlive it.
  void cross(std::size_t cut, std::vector<const Wound*> cuts, std::vector<Crossing> crossings);
  /// All vertices that have entered and still exist.
  std::vector<int> entered() const;

  /// The vertices whose positions the last follow() or move_to() has computed, some perhaps twice.
  const std::vector<int>& touched() const { return touched_; }
  std::size_t active() const { return active_; }          ///< vertices that have entered
  std::size_t late() const { return late_.size(); }       ///< vertices that are waiting to enter
  std::size_t contracted() const { return contracted_; }  ///< in the last follow()

 private:
  BesideCut beside_of(const ActiveVertex& vertex) const;
  /// Vertices that entered together.
  struct Batch {
    ReplayPieces pieces;
    std::size_t left;  ///< vertices that are still in it
  };
  struct Slot {
    int batch = -1, index = 0;
    std::uint32_t version = 0;  ///< of its place: requests for an older one are ignored
  };
  /// The assumed coordinates of a vertex.
  struct Placed {
    bool anywhere = false;
    Side side = Side::both;
    double s = 0, across = 0;  // mm
    double weight = 0;
    Vec3 along;
  };
  /// A vertex gets new coordinates if they are wrong by this distance, mm, T by this angle, rad, or the
  /// weight by this. Over a quarter of a millimetre a wound's displacements change by some hundredths of a
  /// millimetre; updating all vertices with each piece of the path would contract the field many times for
  /// each of them.
  static constexpr double misplaced = 0.25, turned = 0.1, reweighted = 0.05;
  struct Waiting {
    double enters;  ///< mm of the path; or, of those ahead, where it must be known
    int vertex;
    std::uint32_t version;
    bool operator<(const Waiting& other) const { return enters > other.enters; }
  };

  std::vector<int> changed_vertices();
  void follow_path(const std::vector<int>& changed);
  void follow_shape();
  void leave(int vertex);
  void place(int vertex);
  void take_place(int vertex, const std::optional<ActiveVertex>& at);
  void enter();
  void shrink(std::size_t vertices);

  const Wound& wound_;
  const Incision& incision_;
  IncisionVolume& volume_;
  double blade_ = 0, extended_to_ = 0;  // as far as the cut has opened
  std::size_t most_entering_;
  bool undone_ = false;
  Contractor contractor_;
  std::vector<Vec3> rest_, position_;  // number 0 is unused: it receives the results of vertices that left
  std::vector<Slot> slots_;
  std::vector<BesideCut> beside_;
  std::size_t number_ = 0;  // among the cuts that meet
  std::vector<const Wound*> cuts_;
  std::vector<Crossing> crossings_;
  std::vector<Placed> placed_;  // of a path that is extended
  std::vector<Batch> batches_;
  std::priority_queue<Waiting> waiting_;
  std::priority_queue<Waiting> ahead_;  // of what the field's shape is known for
  std::deque<Waiting> late_;
  std::vector<ActiveVertex> entering_;
  std::vector<int> chain_end_;  // vertices of the chain's end as of the last follow()
  std::vector<int> touched_;
  std::size_t active_ = 0, contracted_ = 0;
};

}  // namespace cleft
