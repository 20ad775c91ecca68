// The guard of a wound's skin: what replaces displacements that would turn triangles over or tear edges.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "explorer/guard/guard_moments.h"

namespace cleft {

/// Displacements of some vertices, as sums of parts of the displacements that vertices have without it. The
/// parts are constant in time, but for moments in which the blade passes: then displacements are reduced by a
/// factor that depends on the position of the blade alone, so that time can still run both ways. Without such
/// vertices it costs nothing.
class Guard {
 public:
  struct Share {
    int vertex;
    double part;  ///< of its displacement
  };
  /// By how much the displacement of a vertex differs from that without the guard at most with the cuts
  /// complete, mesh units.
  struct Change {
    int vertex;
    double by;
  };

  /// A triangle of the skin that turns over, shrinks below a fifth of its area or tears in spite of the
  /// guard: a corner, its middle at rest, mesh units, and where the blade is then, mm of a cut.
  struct Unsound {
    int vertex;
    Vec3 place;
    std::size_t cut;
    double s;
    bool torn;  ///< otherwise turned over or shrunk
  };

  /// The displacement of `vertex` is the sum of the shares. Whoever takes from others must not be one of
  /// their shares; whoever takes only a part of its own may be.
  void replace(int vertex, std::span<const Share> shares, double change);
  /// Reduces the displacement of a vertex for a moment; see GuardMoments.
  void hold(int vertex, std::size_t cut, const GuardMoments::Moment& moment) {
    moments_.hold(vertex, cut, moment);
  }
  void name(const Unsound& unsound) { unsound_.push_back(unsound); }
  /// Must be called after the last replace() or hold().
  void sort();
  /// The vertex moves again as without the guard, and so do those that take a share of it.
  void forget(int vertex);

  /// Whether the displacement of a vertex is replaced.
  bool moves(int vertex) const { return row_of(vertex) != nullptr; }
  /// Whether no displacement is replaced; for moments some may be reduced.
  bool empty() const { return rows_.empty(); }
  const GuardMoments& moments() const { return moments_; }
  const std::vector<Change>& changes() const { return changes_; }
  /// Each triangle once, at one of the positions of the blade at which it is so.
  const std::vector<Unsound>& unsound() const { return unsound_; }
  /// The vertices whose displacements are replaced or shared, sorted.
  const std::vector<int>& vertices() const { return vertices_; }

  /// Changes positions without the guard to those with it, with the blade at s mm of a cut. Allocates no
  /// memory.
  void apply(std::size_t cut, double s, const Vec3* rest, Vec3* positions) const;
  /// The displacement of one vertex with the cuts complete, where own(v) is that of vertex v without the
  /// guard.
  template <class Own>
  Vec3 displacement(int vertex, const Own& own) const {
    const Row* row = row_of(vertex);
    if (!row) return own(vertex);
    Vec3 sum;
    for (std::size_t i = row->first; i < row->last; ++i) sum += shares_[i].part * own(shares_[i].vertex);
    return sum;
  }

 private:
  struct Row {
    int vertex;
    bool of_itself;           // it takes a part of its own displacement
    std::size_t first, last;  // of the shares
  };
  const Row* row_of(int vertex) const;

  std::vector<Row> rows_;  // in the order of apply(): those that take from others first, then by vertices
  std::vector<Share> shares_;
  std::vector<Change> changes_;
  std::vector<Unsound> unsound_;
  GuardMoments moments_;
  std::vector<int> vertices_;
};

}  // namespace cleft
