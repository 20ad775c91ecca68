// The opening of a straight cut at the skin, along the cut and over time: the measure of accuracy for the
// whole chain.
#pragma once

#include <optional>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

class Opening {
 public:
  /// Reads all frames. Throws InputError if the cut is not straight, or has no pair of nodes in the skin.
  explicit Opening(const SnapshotReader& reader);

  /// Right lip minus left lip, mm, at s mm of the cut from its start when t mm are cut; linear between nodes
  /// and frames.
  Vec3 at(double s, double t) const;

  const std::vector<double>& along() const {
    return along_;
  }  ///< mm from the start: nodes, both ends included
  const std::vector<double>& times() const { return times_; }  ///< mm
  const Vec3& node(std::size_t frame, std::size_t i) const { return jump_[frame * along_.size() + i]; }
  double largest() const { return largest_; }  ///< mm

 private:
  /// The opening over the square root of the distances from start and tip; none if nothing is open.
  std::optional<Vec3> shape_at(std::size_t frame, double s) const;

  std::vector<double> along_, times_;
  std::vector<Vec3> jump_;  // [frame][along]
  double largest_ = 0;
};

/// Right lip minus left lip of a field, mm.
Vec3 opening(const Field& field, double s, double t);

/// Largest difference at the nodes and frames of `found` over the largest opening of `truth`, which is finer.
double opening_error(const Opening& found, const Opening& truth);

/// Largest difference at the nodes and frames of `truth`, over its largest opening.
double opening_error(const Field& found, const Opening& truth);

}  // namespace cleft
