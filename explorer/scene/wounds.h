// Several cuts in one mesh, made one after the other, and what becomes of the mesh: each opens as its field
// says, in the tension that the others leave.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "explorer/scene/mutual_relief.h"
#include "explorer/scene/replay.h"
#include "explorer/scene/varying_field.h"

namespace cleft {

class Wounds {
 public:
  struct Cut {
    const Incision* incision;
    VaryingField field;
  };

  /// The incisions, all of one mesh and in the order in which they were made, must outlive it, and so must
  /// the fields' own. `scale`: mm per mesh unit. One cut alone is a Replay.
  Wounds(std::vector<Cut> cuts, double scale);

  /// Positions of all vertices, mesh units, with the blade of the last cut at s mm of its path and the others
  /// complete.
  void positions(double s, std::span<Vec3> out) const;

  const std::vector<Vec3>& rest() const { return replays_.back().rest(); }
  std::size_t vertex_count() const { return rest().size(); }
  std::size_t active() const;  ///< vertices that a field moves, counted for every cut
  /// How far a cut opens at s mm of its path, over what it would alone; the last one's blade at its end.
  double amplitude(std::size_t cut, double s) const {
    return relief_.empty() ? 1 : relief_.back()[cut].at(s);
  }

 private:
  double amplitude(std::size_t cut, double s, double blade) const;

  std::vector<Cut> cuts_;
  std::vector<Replay> replays_;
  std::vector<std::vector<Vec3>>
      complete_;                // displacements of all but the last cut: of their active vertices
  std::vector<double> blades_;  // of the last cut, at which the relief is known
  std::vector<std::vector<Amplitude>> relief_;
};

}  // namespace cleft
