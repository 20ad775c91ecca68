// The patch with its cut open, in elements of several kinds: what a frame costs, and how far it opens.
#pragma once

#include <vector>

#include "benchmarks/elements/cut_lines.h"
#include "params/parameters/parameters.h"

namespace cleft::elements {

enum class Kind {
  linear,          ///< the wedges and triangles of cleft solve
  quadratic,       ///< of 15 nodes, and triangles of six
  quarter_points,  ///< the same; middles of edges at a front stand at a quarter of them
  enriched,        ///< linear ones, and the four singular functions of a front at each of its nodes
};

struct Opened {
  std::vector<double> along, opening;  ///< of the open nodes of the skin: mm from the start, mm
  int unknowns = 0;
  double assembly = 0, solution = 0;  ///< processor seconds
};

/// The whole cut open, in small strains, with the tissue's displacement formulation.
Opened open_patch(const Parameters& parameters, const CutLines& lines, Kind kind);

}  // namespace cleft::elements
