// The lines of a patch with a straight cut, for elements of any kind.
#pragma once

#include <vector>

#include "params/parameters/parameters.h"

namespace cleft::elements {

/// How a patch is divided. The cut ends inside its closed nodes by these parts of an element (front_parts).
struct Division {
  int along = 30,
      down = 4;         ///< elements between the closed nodes at the ends, and down to those at the bottom
  double growth = 1.3;  ///< of elements away from the cut
  double towards_fronts = 1;  ///< by which elements within the cut shrink from one to the next toward a front
  double end = 0, bottom = 0;  ///< parts of the outermost elements
};

struct CutLines {
  std::vector<double> u, v, w;  ///< mm; u and v increase, w decreases from the skin at 0
  int first = 0, last = 0;      ///< u lines of the closed nodes at the ends
  int plane = 0, bottom = 0;    ///< v line of the cut, w line of the closed nodes at its bottom
};

/// Across the cut elements begin as long as along it.
CutLines cut_lines(const Parameters& parameters, const Division& division);

}  // namespace cleft::elements
