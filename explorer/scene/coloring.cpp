#include "explorer/scene/coloring.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "base/text.h"
#include "explorer/study/field_on_mesh.h"

namespace cleft {

const std::vector<ColoringText>& colorings() {
  static const std::vector<ColoringText> all{
      {Coloring::tissue, "tissue", "", "skin and the layers of the wound, as they look"},
      {Coloring::own, "own", "", "the mesh's own colours, as its file has them"},
      {Coloring::displacement, "displacement", "displacement, mm", "from the closed frame"},
      {Coloring::gape, "gape", "gape, mm",
       "opening between a point and its mirror image across the cut; on the lips, the gape"},
      {Coloring::strain, "strain", "strain, mm/mm", "largest principal Green-Lagrange strain of the field"},
      {Coloring::difference, "difference", "difference, mm", "from the displacement of another case"},
      {Coloring::widening, "widening", "widening, mm",
       "the gape less that of another case (difference N): above 0 where it opens wider"},
      {Coloring::error, "error", "error of the field, mm",
       "from the displacement of the simulation's nearest node, at the nearest frame"},
  };
  return all;
}

namespace {

const std::string of_quantity = "quantity:";

}  // namespace

ColoringText text_of(const Coloring& coloring) {
  if (coloring.kind == Coloring::quantity)
    return {coloring, of_quantity + coloring.name,
            coloring.name + (coloring.unit.empty() ? "" : ", " + coloring.unit),
            "a quantity of the imported data"};
  return colorings().at(static_cast<std::size_t>(coloring.kind));
}

Coloring coloring_of(const std::string& name, const std::vector<std::string>& quantities) {
  if (name.rfind(of_quantity, 0) == 0) return Coloring(name.substr(of_quantity.size()));
  std::vector<std::string> names;
  for (const ColoringText& c : colorings()) {
    if (c.name == name) return c.coloring;
    names.push_back(c.name);
  }
  for (const std::string& quantity : quantities) {
    if (quantity == name) return Coloring(quantity);
    names.push_back(quantity);
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

double quantity_value(const std::string& name, const Field& field, const Place& place) {
  const auto found = std::find_if(field.quantities.begin(), field.quantities.end(),
                                  [&](const Quantity& q) { return q.name == name; });
  if (found == field.quantities.end()) return std::nan("");
  std::array<double, 6> values{};
  const std::span<double> some(values.data(), static_cast<std::size_t>(found->components));
  field.quantity(static_cast<std::size_t>(found - field.quantities.begin()), place.uvw, place.side, place.t,
                 some);
  return magnitude_of(some);
}

}  // namespace

double color_value(const Coloring& coloring, const VaryingField& field, const Field* reference,
                   const Place& place, double s) {
  switch (coloring.kind) {
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
    case Coloring::widening:
      return reference ? opening_across(field, place, s) - opening_across(VaryingField(*reference), place, 0)
                       : 0;
    case Coloring::error:
      return std::nan("");
    case Coloring::quantity:
      return quantity_value(coloring.name, field.shape(), place);
    case Coloring::tissue:
    case Coloring::own:
      break;
  }
  return 0;
}

}  // namespace cleft
