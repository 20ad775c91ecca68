// Several cuts in one mesh, made one after the other, and what becomes of the mesh: each opens as its field
// says, in the tension that the others leave.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "explorer/scene/mutual_relief.h"
#include "explorer/scene/replay.h"
#include "explorer/scene/validity.h"
#include "explorer/scene/varying_field.h"

namespace cleft {

class Wounds {
 public:
  struct Cut {
    const Incision* incision;
    VaryingField field;
  };

  /// The incisions, all of one mesh and in the order in which they were made, must outlive it, and so must
  /// the fields' own. `scale`: mm per mesh unit; `detail`: mm, as of a Replay.
  Wounds(std::vector<Cut> cuts, double scale, double detail = 0);
  Wounds(const Wounds&) = delete;
  Wounds& operator=(const Wounds&) = delete;

  /// The length of all paths, mm. The blade makes one cut after another: at t it has come to `s` mm of the
  /// path of `cut`, those before are complete, and later ones not begun.
  double duration() const { return begins_.back(); }
  struct Blade {
    std::size_t cut;
    double s;
  };
  Blade blade(double t) const;

  /// Positions of all vertices at t, mesh units. Allocates nothing.
  void positions(double t, std::span<Vec3> out) const;

  /// The displacement of a place below the skin by all cuts at t, mesh units. `nearest` is a vertex of the
  /// skin, `depth` in mm, and sides[k] tells where it lies of cut k if on its surface.
  Vec3 displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                          double t) const;

  const std::vector<Vec3>& rest() const { return replays_.front().rest(); }
  std::size_t vertex_count() const { return rest().size(); }
  std::size_t active() const;    ///< vertices that a field moves, counted for every cut
  std::size_t left_out() const;  ///< those that move too little, likewise
  const std::vector<ActiveVertex>& active(std::size_t cut) const { return replays_[cut].active(); }
  const VaryingField& field(std::size_t cut) const { return cuts_[cut].field; }
  /// How far each cut is like those that replays were compared with. `turned`: whether the fields follow the
  /// tension.
  std::vector<Validity> validity(bool turned) const { return validity_of(in_tension_, turned); }
  /// How far a cut opens at s mm of its path, over what it would alone, with the blade there.
  double amplitude(std::size_t cut, double s, const Blade& blade) const;

 private:
  std::vector<Cut> cuts_;
  double scale_;
  std::vector<double> begins_;  // t at which each cut begins, and the end
  std::vector<Replay> replays_;
  std::vector<std::unique_ptr<IncisionVolume>> volumes_;
  std::vector<CutInTension> in_tension_;
  std::vector<std::vector<Vec3>> complete_;  // displacements of every cut's active vertices, but the last's
  /// While cut k is made: of the cuts until it, with its blade at equal steps of its path.
  std::vector<std::vector<std::vector<Amplitude>>> relief_;
};

}  // namespace cleft
