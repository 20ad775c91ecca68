// The nodes of an open patch in elements of some kind, in the order of elimination.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "benchmarks/elements/cut_lines.h"
#include "benchmarks/elements/open_patch.h"

namespace cleft::elements {

/// A place of the lattice: twice the numbers of the lines, odd ones in the middle of edges.
using Place = std::array<int, 3>;

class PatchNodes {
 public:
  PatchNodes(const CutLines& lines, Kind kind);

  int count() const { return count_; }
  /// The node at a place, of the copy at a side of the cut: -1 or 1.
  int at(const Place& place, int side) const {
    return first_[index(place)] + (side > 0 && is_open(place) ? 1 : 0);
  }
  /// Of an enriched node at a front: the first of four whose unknowns belong to the singular functions.
  int singular(const Place& place) const { return first_[index(place)] + 1; }

  bool is_open(const Place& place) const;
  bool is_end(const Place& place) const;  ///< at an end of the cut: the front stands upright there
  bool is_front(const Place& place) const;
  Vec3 point(const Place& place) const;  ///< of a corner

  const CutLines& lines;
  const Kind kind;

 private:
  int index(const Place& p) const { return (p[2] * size_[1] + p[1]) * size_[0] + p[0]; }
  bool is_node(const Place& place) const;
  void dissect(const Place& from, const Place& to);
  void append(const Place& from, const Place& to);

  Place size_;
  std::vector<int> first_;
  int count_ = 0;
};

}  // namespace cleft::elements
