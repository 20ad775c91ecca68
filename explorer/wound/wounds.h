// Several cuts in one mesh, made one after the other, and what becomes of the mesh: each opens as its field
// says, in the tension that the others leave.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "explorer/wound/mutual_relief.h"
#include "explorer/wound/replay.h"
#include "explorer/wound/validity.h"
#include "explorer/wound/varying_field.h"

namespace cleft {

class Wounds {
 public:
  struct Cut {
    const Incision* incision;
    VaryingField field;
  };

  /// The incisions, all of one mesh and in the order in which they were made, must outlive it, and so must
  /// the fields' own. `scale`: mm per mesh unit.
  Wounds(std::vector<Cut> cuts, double scale);
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

  /// What a frame evaluates.
  struct Level {
    std::vector<Replay> replays;
    /// Of every cut but the last: displacements of its active vertices when it is made.
    std::vector<std::vector<Vec3>> complete;
    double error = 0;              ///< mm by which vertices left out are off at most
    std::size_t active() const;    ///< vertices that a field moves, counted for every cut
    std::size_t left_out() const;  ///< those that move too little, likewise
  };
  /// Without the vertices that all cuts together never move by more than `detail` mm: they stay at rest. The
  /// others move bit for bit as without it.
  Level level(double detail) const;
  const Level& whole() const { return whole_; }

  /// Positions of all vertices at t, mesh units. Allocates nothing.
  void positions(double t, std::span<Vec3> out) const { positions(t, whole_, out); }
  void positions(double t, const Level& level, std::span<Vec3> out) const;

  /// The displacement of a place below the skin by all cuts at t, mesh units. `nearest` is a vertex of the
  /// skin, `depth` in mm, and sides[k] tells where it lies of cut k if on its surface.
  Vec3 displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                          double t) const;

  const std::vector<Vec3>& rest() const { return whole_.replays.front().rest(); }
  std::size_t vertex_count() const { return rest().size(); }
  const std::vector<ActiveVertex>& active(std::size_t cut) const { return whole_.replays[cut].active(); }
  const VaryingField& field(std::size_t cut) const { return cuts_[cut].field; }
  /// How far each cut is like those that replays were compared with. `turned`: whether the fields follow the
  /// tension.
  std::vector<Validity> validity(bool turned) const { return validity_of(in_tension_, turned); }
  /// How far a cut opens at s mm of its path, over what it would alone, with the blade there.
  double amplitude(std::size_t cut, double s, const Blade& blade) const;

 private:
  void bound_vertices();
  double path_length(std::size_t cut) const { return whole_.replays[cut].path_length(); }

  std::vector<Cut> cuts_;
  double scale_;
  std::vector<double> begins_;  // t at which each cut begins, and the end
  Level whole_;
  std::vector<std::unique_ptr<IncisionVolume>> volumes_;
  std::vector<CutInTension> in_tension_;
  /// While cut k is made: of the cuts until it, with its blade at equal steps of its path.
  std::vector<std::vector<std::vector<Amplitude>>> relief_;
  std::vector<double> bounds_;  // by how many mm all cuts together move a vertex at most
};

}  // namespace cleft
