// What must hold of a mesh whatever was cut into it: locally after every step, from the triangles that were
// changed, and over the whole mesh.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft::stress {

class Soundness {
 public:
  explicit Soundness(const CutMesh& mesh);

  /// Takes the mesh's changed triangles in. Returns what is wrong, or nothing.
  std::string step();
  /// Everything again, from the mesh alone.
  std::string whole() const;

  double skin_area() const { return area_; }
  int euler() const;
  long boundary_edges() const { return boundary_; }
  /// Of the skin's triangles that were changed since forget_quality(), the one with the smallest radius
  /// ratio, as they are now; -1 where there is none.
  int worst_new_triangle() const;
  void forget_quality() { touched_.clear(); }

 private:
  struct Known {
    double area = 0;
    int boundary = 0;
    bool there = false;
  };
  std::vector<int> corner_counts() const;
  Known look(int t) const;
  std::string local(int t) const;

  const CutMesh& mesh_;
  std::vector<Known> known_;
  double area_ = 0;
  std::vector<int> touched_;
  long boundary_ = 0, triangles_ = 0;
  std::vector<bool> torn_;  // vertices of the input with more than one fan
};

}  // namespace cleft::stress
