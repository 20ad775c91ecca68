// The cut as a mesh has it: a little longer and deeper than the cut whose opening it simulates.
#pragma once

#include "params/parameters/parameters.h"

namespace cleft {

/// The part of an element by which a cut ends inside its first closed nodes, at the ends of a cut and at its
/// bottom; 0 with mesh.front = "nodes".
///
/// Next to the front of a cut the displacement is K sqrt(r) f(angle). That of a mesh, whose lips meet in a
/// node, differs from it by K h / sqrt(r) g(angle) at distances of many elements h, which is what moving the
/// front by a part of h changes. So the mesh's error is, to first order and everywhere, that of a cut which
/// ends this part before its closed nodes. The part depends on the shape of the elements, and hardly on
/// Poisson's ratio, and is another one of a chess board (has_chess_board); measured with slits in a sheet
/// (ends) and cuts of growing depth (bottom):
/// tests/solver/verification_front_test.cpp; of quadratic elements with benchmarks/elements.
struct FrontParts {
  double end, bottom;
};
FrontParts front_parts(const Parameters& parameters);

/// How far inside its outermost nodes a cut ends, mm: along it, at its bottom, and along a branch.
struct Fronts {
  double along = 0, depth = 0, branch = 0;
};

/// Between the outermost nodes, which stay closed, mm.
struct MeshedCut {
  double length, depth, branch;
  Fronts fronts;
  double step;  ///< of its nodes along it, at most
};

/// Of the longest and deepest cut that the mesh of these parameters is made for.
MeshedCut meshed_cut(const Parameters& parameters);

}  // namespace cleft
