#include "encoder/command/packed.h"

namespace cleft {

void Packer::add(const Field& field) {
  const FieldGeometry& geometry = field.parametrization().geometry();
  add(field.parametrization().name());
  add(geometry.domain), add(geometry.cut), add(geometry.tip.times), add(geometry.tip.positions);
  for (int axis = 0; axis < 4; ++axis) add(field.basis(axis).degree()), add(field.basis(axis).knots());
  add(field.coefficients());
}

Field Unpacker::take_field() {
  const std::string name = take_text();
  FieldGeometry geometry;
  geometry.domain = take<std::array<Interval, 4>>();
  geometry.cut = take<CanonicalCut>();
  geometry.tip.times = take_list<double>(), geometry.tip.positions = take_list<double>();
  std::vector<BSplineBasis> bases;
  for (int axis = 0; axis < 4; ++axis) {
    const int degree = take<int>();
    bases.emplace_back(degree, take_list<double>());
  }
  return {make_parametrization(name, std::move(geometry)),
          {bases[0], bases[1], bases[2], bases[3]},
          take_list<Vec3>()};
}

}  // namespace cleft
