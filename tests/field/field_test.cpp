#include "encoder/field/field.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "encoder/field/quantity_fields.h"
#include "tests/field/random_field.h"

namespace cleft {

namespace {

std::vector<Field> fields() {
  std::vector<Field> list{random_field(), tip_field()};
  // Few frames and few control points: lower degrees, which end before a stencil does.
  for (const int degree : {1, 2}) {
    const std::array<BSplineBasis, 4> bases{
        BSplineBasis::uniform(degree, 4, -30, 30), BSplineBasis::broken(degree, 2 * degree + 3, -20, 0, 20),
        BSplineBasis::uniform(3, 5, -8, 0), BSplineBasis::uniform(degree, degree + 1, 0, 24)};
    list.emplace_back(bases[0], bases[1], bases[2], bases[3], random_coefficients(bases),
                      CanonicalCut{-12, 24, 3});
  }
  // No cut: nothing breaks at v = 0.
  const std::array<BSplineBasis, 4> uncut{
      BSplineBasis::uniform(3, 5, -30, 30), BSplineBasis::uniform(3, 6, -20, 20),
      BSplineBasis::uniform(3, 5, -8, 0), BSplineBasis::uniform(3, 4, 0, 24)};
  list.emplace_back(uncut[0], uncut[1], uncut[2], uncut[3], random_coefficients(uncut), CanonicalCut{});
  return list;
}

}  // namespace

TEST(Field, EveryKernelEqualsTheSumOfItsDefinition) {
  EXPECT_EQ(available_kernels().front(), Kernel::plain);
  for (Field field : fields()) {
    const std::vector<Place> places = all_kinds_of_places(field);
    std::vector<Vec3> batch(places.size());
    for (const Kernel kernel : available_kernels()) {
      field.use(kernel);
      field.displacements(places, batch);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [uvw, side, t] = places[i];
        ASSERT_LT(norm(batch[i] - by_definition(field, places[i])), rounding) << name_of(kernel) << ' ' << i;
        ASSERT_EQ(field.displacement(uvw, side, t), batch[i]);
      }
    }
  }
}

TEST(Field, CollapsedToATimeItIsTheSame) {
  CollapsedField collapsed;
  for (Field field : fields())
    for (const Kernel kernel : available_kernels()) {
      field.use(kernel);
      std::vector<Place> places = all_kinds_of_places(field, 100);
      std::vector<Vec3> batch(places.size());
      for (const double t : {-1., 0., 3.7, 10., 24.}) {
        field.collapse(t, collapsed);
        collapsed.displacements(places, batch);
        for (std::size_t i = 0; i < places.size(); ++i) {
          const Vec3 direct = field.displacement(places[i].uvw, places[i].side, t);
          ASSERT_LT(norm(batch[i] - direct), rounding) << name_of(kernel);
          ASSERT_EQ(collapsed.displacement(places[i].uvw, places[i].side), batch[i]);
        }
      }
    }
}

TEST(Field, CopiesStandAlone) {
  auto original = std::make_unique<Field>(tip_field());
  Field copy = *original, moved = std::move(*original);
  original.reset();
  const Field again = tip_field();
  for (const Place& p : all_kinds_of_places(again, 30)) {
    EXPECT_EQ(copy.displacement(p.uvw, p.side, p.t), again.displacement(p.uvw, p.side, p.t));
    EXPECT_EQ(moved.displacement(p.uvw, p.side, p.t), again.displacement(p.uvw, p.side, p.t));
  }
}

TEST(Field, OnThePlaneTheSideChoosesTheLip) {
  for (const Field& field : {random_field(), tip_field()}) {
    const Vec3 p{4, 0, -2};
    const Vec3 left = field.displacement(p, Side::left, 9), right = field.displacement(p, Side::right, 9);
    EXPECT_GT(norm(left - right), 0.1) << "random sides must differ";
    EXPECT_LT(norm(field.displacement(p, Side::both, 9) - lerp(left, right, 0.5)), rounding);
    // Each lip is the limit of its side: over 1e-9 mm a cubic with coefficients of size 1 on spans of 5 mm
    // moves by less than 1e-8.
    EXPECT_LT(norm(left - field.displacement({4, -1e-9, -2}, Side::both, 9)), 1e-8);
    EXPECT_LT(norm(right - field.displacement({4, 1e-9, -2}, Side::both, 9)), 1e-8);
  }
}

TEST(Field, QuantitiesStandOnTheSameBases) {
  for (Field field : fields()) {
    const std::size_t count = field.coefficients().size();
    Quantity same{"displacement", 3, {}}, stress{"stress", 6, std::vector<double>(6 * count)},
        temperature{"temperature", 1, std::vector<double>(count)};
    for (std::size_t i = 0; i < count; ++i) {
      for (int d = 0; d < 3; ++d) {
        const double c = field.coefficients()[i][d];
        same.coefficients.push_back(c);
        stress.coefficients[6 * i + static_cast<std::size_t>(d)] = c;
        stress.coefficients[6 * i + static_cast<std::size_t>(d) + 3] = 10 + c;
      }
      temperature.coefficients[i] = 37 - field.coefficients()[i].y;
    }
    field.quantities = {same, stress, temperature};
    const std::vector<Place> places = all_kinds_of_places(field, 100);
    for (std::size_t q = 0; q < field.quantities.size(); ++q) {
      const QuantityFields at_once(field, q);
      std::vector<double> all(places.size() * at_once.components()), one(at_once.components());
      at_once.at(places, all);
      for (std::size_t n = 0; n < places.size(); ++n) {
        field.quantity(q, places[n].uvw, places[n].side, places[n].t, one);
        for (std::size_t c = 0; c < one.size(); ++c)
          EXPECT_NEAR(all[n * one.size() + c], one[c], 40 * rounding) << q << " " << c;
      }
    }
    for (const Place& p : places) {
      const Vec3 d = field.displacement(p.uvw, p.side, p.t);
      double three[3], six[6], one[1];
      field.quantity(0, p.uvw, p.side, p.t, three);
      field.quantity(1, p.uvw, p.side, p.t, six);
      field.quantity(2, p.uvw, p.side, p.t, one);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(three[i], d[i], rounding);
        EXPECT_NEAR(six[i], d[i], rounding);
        EXPECT_NEAR(six[3 + i], 10 + d[i], 10 * rounding);
      }
      EXPECT_NEAR(one[0], 37 - d.y, 40 * rounding);
    }
  }
}

TEST(Field, DegreesAboveThreeAreRefused) {
  const BSplineBasis a = BSplineBasis::uniform(4, 5, 0, 1), v = BSplineBasis::broken(3, 8, -1, 0, 1),
                     b = BSplineBasis::uniform(3, 4, 0, 1);
  EXPECT_THROW(Field(a, v, b, b, std::vector<Vec3>(5 * 8 * 4 * 4), {0, 1, 1}), InputError);
}

}  // namespace cleft
