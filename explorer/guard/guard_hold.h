// Displacements that are reduced for a moment, around triangles that are not sound while the blade passes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "explorer/guard/guard_search.h"

namespace cleft {

class GuardHold {
 public:
  /// What the search has found must not change any more. It must outlive this.
  explicit GuardHold(const GuardSearch& search);

  /// The blade at s mm of a cut that ends at `end`. A moment lasts while it goes from `first` to `last`, and
  /// begins and ends over `fade` mm of its way. The displacement of a vertex is that at s, with what the
  /// guard replaces for good and without its moments.
  struct Passing {
    std::size_t cut;
    double s, first, last, end, fade;
    std::function<Vec3(int vertex)> displacement;
  };
  /// Reduces displacements for a moment, so that the given triangle or pair (as in GuardSearch::Remaining)
  /// and all around it are sound. Returns the triangles around those that are reduced.
  std::vector<int> hold(int one, const Passing& passing, Guard& guard);

 private:
  /// A vertex whose displacement has been asked for.
  struct Held {
    int moment = 0;  // the one in which it was; what follows is of an earlier one if it is another
    Vec3 own;        // its displacement
    double length;   // of that
    double before;   // the part of it that other moments leave
    double part;     // and this one, which rises from vertex to vertex whatever others do: they end elsewhere
    double least() const { return std::min(before, part); }
  };

  Held& at(int number);
  Vec3 now(int vertex);
  bool is_sound(int one);
  void reduce(int number, double part);
  void lower(int one);
  void spread();
  void add_around(int number);
  void add(int one);

  const GuardSearch& search_;
  const Passing* passing_ = nullptr;
  const GuardMoments* moments_ = nullptr;
  int moment_ = 0, round_ = 0;
  std::vector<std::vector<int>> linked_;  // by numbers: tied to each other, or joined
  std::vector<Held> held_;                // by numbers
  std::vector<int> asked_;                // numbers: those of this moment
  std::vector<int> seen_;                 // [triangle, pair]: the last round in which it was added
  std::vector<int> around_;               // those whose displacements have changed, each once
  std::priority_queue<std::pair<double, int>> queue_;  // the least part first
};

}  // namespace cleft
