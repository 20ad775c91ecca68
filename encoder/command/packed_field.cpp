#include "encoder/command/packed_field.h"

namespace cleft {

void add(Packer& message, const Field& field) {
  const FieldGeometry& geometry = field.parametrization().geometry();
  message.add(field.parametrization().name());
  message.add(geometry.domain), message.add(geometry.cut), message.add(geometry.tip.times),
      message.add(geometry.tip.positions);
  for (int axis = 0; axis < 4; ++axis)
    message.add(field.basis(axis).degree()), message.add(field.basis(axis).knots());
  message.add(field.coefficients());
}

Field take_field(Unpacker& message) {
  const std::string name = message.take_text();
  FieldGeometry geometry;
  geometry.domain = message.take<std::array<Interval, 4>>();
  geometry.cut = message.take<CanonicalCut>();
  geometry.tip.times = message.take_list<double>(), geometry.tip.positions = message.take_list<double>();
  std::vector<BSplineBasis> bases;
  for (int axis = 0; axis < 4; ++axis) {
    const int degree = message.take<int>();
    bases.emplace_back(degree, message.take_list<double>());
  }
  return {make_parametrization(name, std::move(geometry)),
          {bases[0], bases[1], bases[2], bases[3]},
          message.take_list<Vec3>()};
}

}  // namespace cleft
