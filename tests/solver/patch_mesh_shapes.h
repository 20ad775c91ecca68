// Cases with all shapes of cuts.
#pragma once

#include <string>
#include <vector>

#include "params/consistency.h"
#include "tests/solver/small_patch.h"
#include "tests/support/even_piece.h"

namespace cleft {

inline Parameters awkward_patch() {  // nothing is a multiple of the element size
  Parameters p = even_piece();
  p.patch.length = 31.3, p.patch.width = 17.1, p.patch.height = 7.7;
  p.cut.length = 12.9, p.cut.depth = 3.1;
  p.mesh.element_size = 0.93;
  return p;
}

struct Shape {
  std::string name;
  Parameters parameters;
};

template <class Change>
Shape shape(const char* name, Parameters p, Change change) {
  change(p);
  check_consistency(p, name);
  return {name, p};
}

/// All that a cut can be, alone and together.
inline std::vector<Shape> shapes() {
  const Parameters small = small_patch(), awkward = awkward_patch();
  return {
      shape("straight", small, [](Parameters&) {}),
      shape("awkward", awkward, [](Parameters&) {}),
      shape("odd", small, [](Parameters& p) { p.cut.length = 4.7; }),
      shape("graded", awkward, [](Parameters& p) { p.mesh.grading = 1.3; }),
      shape("larger mesh", small, [](Parameters& p) { p.mesh.cut_length = 8.2, p.mesh.cut_depth = 2.7; }),
      shape("arc", awkward, [](Parameters& p) { p.cut.radius = 8; }),
      shape("wide arc, larger mesh", small, [](Parameters& p) { p.cut.radius = 50, p.mesh.cut_length = 9; }),
      shape("tilt", small, [](Parameters& p) { p.cut.tilt = 30; }),
      shape("tilt back, graded", awkward, [](Parameters& p) { p.cut.tilt = -50, p.mesh.grading = 1.2; }),
      shape("tilted arc, graded", awkward,
            [](Parameters& p) { p.cut.radius = 9, p.cut.tilt = 40, p.mesh.grading = 1.5; }),
      shape("three", small, [](Parameters& p) { p.cut.count = 3, p.cut.spacing = 1.7; }),
      shape("two tilted arcs, graded", awkward,
            [](Parameters& p) {
              p.cut.count = 2, p.cut.spacing = 2.9, p.cut.radius = 12, p.cut.tilt = -20, p.mesh.grading = 1.1;
            }),
      shape("two of one column", small,
            [](Parameters& p) { p.cut.count = 2, p.cut.length = 2, p.cut.spacing = 0.3; }),
      shape("branch of one column", small, [](Parameters& p) { p.cut.branch = 1, p.cut.length = 2; }),
      shape("branch longer than the cut", small,
            [](Parameters& p) { p.cut.branch = 3.7, p.cut.length = 2.9, p.patch.width = 10; }),
      shape("branch", small, [](Parameters& p) { p.cut.branch = 1.9; }),
      shape("branch, awkward, larger mesh", awkward,
            [](Parameters& p) {
              p.cut.branch = 4.4, p.mesh.grading = 1.4, p.mesh.cut_length = 17.7, p.mesh.cut_depth = 4.2;
            }),
      shape("branch of a tilted arc", awkward,
            [](Parameters& p) { p.cut.branch = 2.5, p.cut.radius = 14, p.cut.tilt = 25; }),
  };
}

inline int incisions(const Parameters& p) { return p.cut.branch > 0 ? 2 : static_cast<int>(p.cut.count); }

}  // namespace cleft
