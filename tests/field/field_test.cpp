#include "encoder/field/field.h"

#include <gtest/gtest.h>

#include "tests/field/random_field.h"

namespace cleft {

namespace {

/// The four-fold sum of the definition.
Vec3 by_definition(const Field& f, const Vec3& p, Limit side, double t) {
  const double at[] = {p.x, p.y, p.z, t};
  std::array<std::vector<double>, 4> value;
  for (int axis = 0; axis < 4; ++axis) {
    const auto b = f.basis(axis).evaluate(at[axis], axis == 1 ? side : Limit::from_right);
    value[axis].assign(f.basis(axis).size(), 0);
    for (int i = 0; i <= 3; ++i) value[axis][b.first + i] = b.value[i];
  }
  Vec3 sum;
  std::size_t next = 0;
  for (const double u : value[0])
    for (const double v : value[1])
      for (const double w : value[2])
        for (const double s : value[3]) sum += u * v * w * s * f.coefficients()[next++];
  return sum;
}

History contracted(const Field& field, const Vec3& p) {
  History history;
  field.contract(p, Side::both, 0, history);
  return history;
}

constexpr double rounding =
    1e-13;  // a few hundred operations on numbers of size 1, a cubic through four points

}  // namespace

TEST(Field, EqualsTheSumOfItsDefinitionAndItsContraction) {
  const Field field = random_field();
  for (const Vec3& p : {Vec3{-30, -20, -8}, {30, 20, 0}, {3.3, 4.4, -5.5}, {-7, -0.001, -1}, {0, 11, 0}})
    for (const double t : {0.0, 5.5, 24.0}) {
      const Vec3 direct = field.displacement(p, Side::both, t);
      EXPECT_LT(norm(direct - by_definition(field, p, p.y < 0 ? Limit::from_left : Limit::from_right, t)),
                rounding);
      EXPECT_LT(norm(direct - evaluate(contracted(field, p), t)), rounding);
    }
}

TEST(Field, OnThePlaneTheSideChoosesTheLip) {
  const Field field = random_field();
  const Vec3 p{4, 0, -2};
  const Vec3 left = field.displacement(p, Side::left, 9), right = field.displacement(p, Side::right, 9);
  EXPECT_LT(norm(left - by_definition(field, p, Limit::from_left, 9)), rounding);
  EXPECT_LT(norm(right - by_definition(field, p, Limit::from_right, 9)), rounding);
  EXPECT_GT(norm(left - right), 0.1) << "random sides must differ";
  const Vec3 mean = lerp(left, right, 0.5);
  EXPECT_LT(norm(field.displacement(p, Side::both, 9) - mean), rounding);
  EXPECT_LT(norm(evaluate(contracted(field, p), 9) - mean), rounding);
  // Each lip is the limit of its side: over 1e-9 mm a cubic with coefficients of size 1 on spans of 5 mm
  // moves by less than 1e-8.
  EXPECT_LT(norm(left - field.displacement({4, -1e-9, -2}, Side::both, 9)), 1e-8);
  EXPECT_LT(norm(right - field.displacement({4, 1e-9, -2}, Side::both, 9)), 1e-8);
}

}  // namespace cleft
