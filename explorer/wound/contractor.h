// From a field to the histories of active vertices, which replays evaluate; each is contracted once.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "explorer/wound/ipv.h"
#include "explorer/wound/replay_pieces.h"
#include "explorer/wound/varying_field.h"

namespace cleft {

class Contractor {
 public:
  /// The fields that `field` refers to must outlive it. `scale` is mm per mesh unit.
  Contractor(VaryingField field, double scale);

  const VaryingField& field() const { return field_; }

  /// Sorts into the order that contract() needs: by time offsets, then by memory.
  static void sort(std::vector<ActiveVertex>& active);

  /// The histories in the mesh's space, weighted and in its units, to within the field's
  /// contraction_tolerance(). A vertex of the cut has a second history for the time before the blade passes
  /// it. The displacement of vertex v is written to number v + `shift`. `reach`: that of ReplayPieces, beyond
  /// which there may be no history.
  ReplayPieces contract(const std::vector<ActiveVertex>& sorted, int shift = 0,
                        double reach = std::numeric_limits<double>::infinity()) const;

 private:
  std::vector<double> times_to(double last) const;
  void history(const ActiveVertex& vertex, Side side, std::span<const double> times, History& out) const;

  VaryingField field_;
  double scale_;
  std::vector<double> times_;
};

}  // namespace cleft
