#include "params/meshed_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleft {

namespace {

/// `part` of the longest elements that fit: n of them are as long as the cut and the parts beyond its `ends`.
double front_of(double length, double size, double part, int ends) {
  const double count = std::max(1., std::ceil(length / size + ends * part - 1e-9));
  return part * length / (count - ends * part);
}

/// Of elements along a cut, in mesh.element_size. At the ends of a cut, and at its tip, the thin lip over a
/// tilted blade rises within a few elements: under 45 degrees, 3 mm deep, with elements of 0.8 mm along it,
/// by 1.5 % of the opening too little, with 0.52 by 0.4 %.
double part_along(const Parameters& p) { return std::cos(p.cut.tilt * std::numbers::pi / 180); }

}  // namespace

FrontParts front_parts(const Parameters& p) {
  if (p.mesh.front == MeshFront::nodes) return {0, 0};
  if (p.mesh.elements == ElementOrder::quadratic) return {0.1, 0.1};
  return has_chess_board(p) ? FrontParts{0.32, 0.18} : FrontParts{0.42, 0.3};
}

MeshedCut meshed_cut(const Parameters& p) {
  MeshedCut cut{p.mesh.cut_length > 0 ? p.mesh.cut_length : p.cut.length,
                p.mesh.cut_depth > 0 ? p.mesh.cut_depth : p.cut.depth,
                p.cut.branch,
                {},
                part_along(p) * p.mesh.element_size};
  const FrontParts parts = front_parts(p);
  const double size = p.mesh.element_size;
  // A branch leaves the middle of the cut, where a node is: each half has its own elements.
  cut.fronts.along = p.cut.branch > 0 ? front_of(cut.length / 2, cut.step, parts.end, 1)
                                      : front_of(cut.length, cut.step, parts.end, 2);
  cut.fronts.depth = front_of(cut.depth, size, parts.bottom, 1);
  cut.length += 2 * cut.fronts.along, cut.depth += cut.fronts.depth;
  if (p.cut.branch > 0) {
    cut.fronts.branch = front_of(p.cut.branch, size, parts.end, 1);
    cut.branch += cut.fronts.branch;
  }
  return cut;
}

}  // namespace cleft
