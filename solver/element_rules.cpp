#include "solver/element_rules.h"

#include <deal.II/base/quadrature_lib.h>

namespace cleft {

using namespace dealii;

Quadrature<3> wedge_rule(WedgeRule rule, ElementOrder order) {
  if (order == ElementOrder::quadratic) return QGaussWedge<3>(3);
  std::vector<Point<2>> triangle = {Point<2>(1. / 3, 1. / 3)};
  if (rule == WedgeRule::full) triangle = {{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}};
  std::vector<Point<3>> points;
  const QGauss<1> axis(2);
  for (const Point<2>& p : triangle)
    for (const Point<1>& z : axis.get_points()) points.emplace_back(p[0], p[1], z[0]);
  return {points, std::vector<double>(points.size(), 0.5 / static_cast<double>(points.size()))};
}

hp::QCollection<2> face_rules(ElementOrder order) {
  const unsigned points = order == ElementOrder::quadratic ? 3 : 2;
  const QGaussSimplex<2> triangle(points);
  const QGauss<2> quad(points);
  return hp::QCollection<2>(triangle, triangle, quad, quad, quad);
}

std::array<int, 3> corners_of_face(const DoFHandler<3>::active_cell_iterator& cell, unsigned face) {
  std::array<int, 3> corners{};
  for (unsigned i = 0; i < 3; ++i)
    for (const unsigned v : cell->vertex_indices())
      if (cell->vertex_index(v) == cell->face(face)->vertex_index(i)) corners[i] = static_cast<int>(v);
  return corners;
}

}  // namespace cleft
