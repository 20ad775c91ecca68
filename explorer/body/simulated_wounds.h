// The cuts of a mesh, moved as a simulation of this very body says: each vertex by the three nodes of the
// body's skin, or of a wall of its cuts, between which it lies.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "explorer/body/vertex_places.h"
#include "explorer/guard/guard.h"
#include "explorer/incision/incision.h"
#include "solver/body/body.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// How far replayed positions are from simulated ones: of the displacement of any vertex, over the largest
/// one, and of the vectors from lip to lip along the cuts, over the largest opening. Lengths in mesh units.
struct ReplayOff {
  double largest = 0, displacement = 0;
  double gape = 0, opening = 0;
  double relative_displacement() const { return largest > 0 ? displacement / largest : 0; }
  double relative_opening() const { return gape > 0 ? opening / gape : 0; }
};

class SimulatedWounds {
 public:
  /// `cuts`: all of one mesh, complete, in the order in which they were made, along the paths of the body.
  /// `scale` is mm per mesh unit. Throws InputError if the series is not that of the body.
  SimulatedWounds(const std::vector<const Incision*>& cuts, double scale, const Body& body,
                  const SnapshotReader& series);

  /// The length of all paths, mm.
  double duration() const { return times_.back(); }
  /// How far from the ends of cuts vertices take the place of others, mesh units: a body is cut beyond them,
  /// up to its next nodes, and what is there is moved to the ends of the mesh.
  double reach_of_ends() const { return reach_of_ends_; }
  int active() const { return static_cast<int>(places_.size()); }

  /// Positions of all vertices at t, mesh units: between two frames of the series in proportion, and with the
  /// guard. Allocates no memory.
  void positions(double t, std::span<Vec3> out) const;
  /// The same without the guard: nothing but the simulation.
  void bare_positions(double t, std::span<Vec3> out) const;
  /// What keeps triangles of this mesh from turning over where the simulated skin folds, or where they are
  /// too large or too slender for it. Empty where none turns over, and where most of the wound does.
  const Guard& guard() const { return guard_; }
  /// How far replayed positions at t are from the simulation itself, that is without the guard; where the
  /// mesh takes the ends of the body does not count. `cuts`: those that were simulated.
  ReplayOff off(const std::vector<const Incision*>& cuts, std::span<const Vec3> replayed, double t) const;

  /// The largest opening at t, mm.
  double gape(double t) const;

  using Place = VertexPlace;
  const std::vector<Place>& places() const { return places_; }
  Vec3 displacement(const Place& place, double t) const;  ///< mm

 private:
  struct Moment {
    std::size_t frame;
    double part;  ///< of the next one
  };
  Moment moment(double t) const;
  Vec3 of_node(int node, const Moment& at) const;  // displacement, mm
  void find_guard(const CutMesh& mesh);

  double scale_, reach_of_ends_;
  std::vector<double> times_;
  std::vector<std::vector<std::array<float, 3>>> frames_;  // mm, by node
  std::vector<BodyPair> pairs_;
  std::vector<Vec3> rest_;
  std::vector<Place> places_;  // in the order of vertices, of those that move
  Guard guard_;
};

/// Triangles of the skin that are turned over (guard_search.h). `positions`: of all vertices.
std::vector<int> turned_triangles(const CutMesh& mesh, std::span<const Vec3> positions);

/// Vertices within `end` of the ends of cuts do not count, mesh units.
ReplayOff replay_off(const std::vector<const Incision*>& cuts, std::span<const Vec3> replayed,
                     std::span<const Vec3> simulated, double end);

}  // namespace cleft
