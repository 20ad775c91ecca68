#include "explorer/scene/coloring.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

const std::vector<ColoringText>& colorings() {
  static const std::vector<ColoringText> all{
      {Coloring::tissue, "tissue", "", "skin and the layers of the wound, as they look"},
      {Coloring::displacement, "displacement", "displacement, mm", "from the closed frame"},
      {Coloring::gape, "gape", "gape, mm",
       "opening between a point and its mirror image across the cut; on the lips, the gape"},
      {Coloring::strain, "strain", "strain, mm/mm", "largest principal Green-Lagrange strain of the field"},
      {Coloring::difference, "difference", "difference, mm", "from the displacement of another case"},
      {Coloring::error, "error", "error of the field, mm",
       "from the displacement of the simulation's nearest node, at the nearest frame"},
  };
  return all;
}

const ColoringText& text_of(Coloring coloring) { return colorings().at(static_cast<std::size_t>(coloring)); }

Coloring coloring_of(const std::string& name) {
  std::vector<std::string> names;
  for (const ColoringText& c : colorings()) {
    if (c.name == name) return c.coloring;
    names.push_back(c.name);
  }
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "" : ", ") + n;
  throw InputError("'" + name + "' is no colouring" + did_you_mean(name, names) + "; there are " + list);
}

namespace {

double opening_across(const VaryingField& field, const Place& place, double s) {
  if (place.side == Side::both && place.uvw.y == 0) return 0;
  const Vec3 right{place.uvw.x, std::abs(place.uvw.y), place.uvw.z}, left{right.x, -right.y, right.z};
  return norm(field.displacement(right, Side::right, place.t, s) -
              field.displacement(left, Side::left, place.t, s));
}

double largest_strain(const VaryingField& field, const Place& place, double s) {
  const Derivatives d = field.derivatives(place.uvw, place.side, place.t, s);
  Eigen::Matrix3d gradient;
  const Vec3* columns[] = {&d.by_u, &d.by_v, &d.by_w};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) gradient(i, j) = (*columns[j])[i] + (i == j);
  const Eigen::Matrix3d strain = (gradient.transpose() * gradient - Eigen::Matrix3d::Identity()) / 2;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(strain, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

}  // namespace

double color_value(Coloring coloring, const VaryingField& field, const Field* reference, const Place& place,
                   double s) {
  switch (coloring) {
    case Coloring::displacement:
      return norm(field.displacement(place.uvw, place.side, place.t, s));
    case Coloring::gape:
      return opening_across(field, place, s);
    case Coloring::strain:
      return largest_strain(field, place, s);
    case Coloring::difference:
      return reference ? norm(field.displacement(place.uvw, place.side, place.t, s) -
                              reference->displacement(place.uvw, place.side, place.t))
                       : 0;
    case Coloring::error:
      return std::nan("");
    case Coloring::tissue:
      break;
  }
  return 0;
}

}  // namespace cleft
