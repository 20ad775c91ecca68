// The wound at any position of the blade: each frame is computed from the rest positions, so that time can
// run both ways and errors do not accumulate.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "explorer/wound/replay_pieces.h"
#include "explorer/wound/wound.h"

namespace cleft {

class Contractor;

class Replay {
 public:
  /// Contracts the wound's field once for each active vertex, to within its contraction_tolerance(), and does
  /// not read the wound afterwards. Vertices that never move by more than `detail`, mm, stay at rest and are
  /// not evaluated.
  explicit Replay(const Wound& wound, double detail = 0);

  /// Positions of all vertices, mesh units, with the blade at s mm of the path's length. `out` has one entry
  /// for each vertex of the incision's mesh. Allocates no memory.
  void positions(double s, std::span<Vec3> out) const;
  /// The same of active vertices only, bit for bit.
  void active_positions(double s, std::span<Vec3> out) const {
    pieces_.positions(opened_to_(s), rest_->data(), out.data());
  }

  /// The displacement of active()[i] alone, mesh units; positions() may round it otherwise.
  Vec3 displacement(std::size_t i, double s) const { return pieces_.displacement(i, opened_to_(s)); }

  double path_length() const { return path_length_; }  ///< mm
  std::size_t vertex_count() const { return rest_->size(); }
  const std::vector<ActiveVertex>& active() const { return active_; }
  std::size_t left_out() const { return left_out_; }  ///< vertices that move too little
  /// A bound of the motion of active()[i], mm, by its control points.
  double bound(std::size_t i) const { return scale_ * pieces_.bound(i); }
  const std::vector<Vec3>& rest() const { return *rest_; }

  /// The same with only active()[chosen[k]] moving, bit for bit as before; `chosen` ascends.
  Replay of(const std::vector<std::size_t>& chosen) const;

 private:
  Replay(const Wound& wound, const Contractor& contractor);
  Replay(const Replay& whole, ReplayPieces few)
      : path_length_(whole.path_length_),
        scale_(whole.scale_),
        opened_to_(whole.opened_to_),
        rest_(whole.rest_),
        pieces_(std::move(few)) {}

  double path_length_, scale_;
  OpenedTo opened_to_;
  std::shared_ptr<const std::vector<Vec3>> rest_;
  std::vector<ActiveVertex> active_;  // in the order of their time offsets
  std::size_t left_out_ = 0;
  ReplayPieces pieces_;
};

}  // namespace cleft
