// The wounds of a mesh in which all cuts are known, at any time: their replays, superposed.
#pragma once

#include "explorer/wound/replay.h"
#include "explorer/wound/wounds.h"

namespace cleft {

class ReplayedWounds : public Wounds {
 public:
  /// At least one, all in one mesh, in the order in which they were made. Throws InputError if the fields
  /// lack the parameters for the mutual relief of several cuts.
  explicit ReplayedWounds(std::vector<Wound> wounds);

  /// The length of all paths, mm. The blade makes one cut after another: blade(t) is its position after t mm.
  double duration() const { return begins_.back(); }
  Blade blade(double t) const;

  /// The data that a frame evaluates.
  struct Level {
    std::vector<Replay> replays;
    /// For every cut but the last: displacements of its active vertices when it is complete.
    std::vector<std::vector<Vec3>> complete;
    std::vector<std::vector<BesideCut>> beside;  ///< active vertices, of every cut
    double error = 0;                            ///< bound of the error of vertices left out, mm
    std::size_t active() const;                  ///< vertices that a field moves, counted for every cut
    std::size_t left_out() const;                ///< those that move too little, likewise
  };
  /// Without the vertices that all cuts together never move by more than `detail`, mm, which stay at rest.
  /// All others move as before, bit for bit.
  Level level(double detail) const;
  const Level& whole() const { return whole_; }

  /// Positions of all vertices at t, mesh units. Allocates no memory.
  void positions(double t, std::span<Vec3> out) const { positions(t, whole_, out); }
  void positions(double t, const Level& level, std::span<Vec3> out) const;

  const std::vector<Vec3>& rest() const { return whole_.replays.front().rest(); }
  std::size_t vertex_count() const { return rest().size(); }
  const std::vector<ActiveVertex>& active(std::size_t cut) const { return whole_.replays[cut].active(); }

 private:
  void superpose(const Blade& blade, const Level& level, std::span<Vec3> out) const;
  void bound_vertices();
  double path_length(std::size_t cut) const { return whole_.replays[cut].path_length(); }

  std::vector<double> begins_;  // t at which each cut begins, and the end
  Level whole_;
  std::vector<double> bounds_;  // bounds of the motion of each vertex by all cuts, mm
};

}  // namespace cleft
