// The blade at s: the line through C(s) along N(s), and where it pierces a mesh. Inside explorer/incision
// only.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// Whether the blade pierces a triangle that faces along N: exact for the frame's numbers.
bool pierces(const CutMesh& mesh, int t, const PathFrame& frame);

/// The first of `triangles` that the blade pierces, or -1.
int pierced(const CutMesh& mesh, const std::vector<int>& triangles, const PathFrame& frame);

/// The place where the blade pierces a triangle, which it must pierce.
Vec3 piercing_point(const CutMesh& mesh, int t, const PathFrame& frame);

/// Zero of a function that is at least 0 at lo and negative at hi: secant kept inside its bracket (Illinois).
template <class F>
double zero_between(double lo, double hi, const F& f) {
  double at_lo = f(lo), at_hi = f(hi);
  if (!(at_lo > 0)) return lo;
  if (!(at_hi < 0)) return hi;
  const double enough = IncisionTolerances::zero_accuracy * hi;
  double x = lo;
  for (int k = 0, last = 0; k < IncisionTolerances::zero_steps && hi - lo > enough; ++k) {
    x = lo + at_lo * (hi - lo) / (at_lo - at_hi);
    const double y = f(x);
    if (y == 0) break;
    if (y > 0) {
      lo = x, at_lo = y;
      if (last == -1) at_hi /= 2;
      last = -1;
    } else {
      hi = x, at_hi = y;
      if (last == 1) at_lo /= 2;
      last = 1;
    }
  }
  return x;
}

}  // namespace cleft
