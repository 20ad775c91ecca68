// Displacements that are reduced for moments: while the blade passes, a lip opens all of a sudden, and
// triangles next to the tip may turn over that lie well before and afterwards. To hold the lips back for good
// would cost the opening; here they wait until the blade has gone on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/vec3.h"

namespace cleft {

class GuardMoments {
 public:
  /// With the blade between `first` and `last`, mm, a displacement is multiplied by `part`, from 0 to 1; over
  /// `before` and `after`, mm, it goes back to 1 linearly on either side.
  struct Moment {
    double first, last, part, before, after;
    double at(double s) const;
    bool covers(const Moment& other) const;  ///< leaves as little or less, wherever the blade is
  };

  /// Leaves out what other moments of the vertex cover.
  void hold(int vertex, std::size_t cut, const Moment& moment);
  /// Must be called after the last hold(), and before apply().
  void sort();

  /// The part of its displacement that a vertex keeps with the blade at s mm of a cut: the least of its
  /// moments. 1 at both ends of each cut.
  double part(int vertex, std::size_t cut, double s) const;
  /// Appends the positions of the blade, mm, at which moments of a vertex begin, are full, and end.
  void add_turns(int vertex, std::size_t cut, std::vector<double>& turns) const;
  std::size_t count() const { return count_; }  ///< of moments that no other one covers
  /// Those whose displacements are reduced at any time; some perhaps twice.
  std::vector<int> vertices() const;
  /// Multiplies the displacements of all vertices. Allocates no memory.
  void apply(std::size_t cut, double s, const Vec3* rest, Vec3* positions) const;

 private:
  static double least(std::span<const Moment> moments, double s);
  /// From where to where the blade meets the moments of a vertex, and which these are in moments_.
  struct Held {
    double first, last;
    int vertex;
    std::size_t begin, count;
  };

  std::vector<std::unordered_map<int, std::vector<Moment>>> of_cut_;
  std::vector<std::vector<Held>> held_;  // [cut], by the first place
  std::vector<Moment> moments_;
  std::size_t count_ = 0;
};

}  // namespace cleft
