// Evaluation takes nothing from the heap, once buffers of the caller's have grown.
#include <gtest/gtest.h>

#include "tests/field/random_field.h"
#include "tests/support/allocations.h"

namespace cleft {

TEST(Allocation, IsCounted) {
  const std::size_t before = allocations();
  const auto one = std::make_unique<int>(1);
  const std::vector<double, LineAllocator<double>> two(3);
  EXPECT_EQ(allocations(), before + 2);
}

TEST(Allocation, NoneInAnyEvaluation) {
  for (Field field : {random_field(), tip_field()}) {
    field.quantities = {{"stress", 6, std::vector<double>(6 * field.coefficients().size(), 1)}};
    const std::vector<Place> places = all_kinds_of_places(field, 100);
    std::vector<Vec3> out(places.size());
    double stress[6];
    History history;
    CollapsedField collapsed;
    const auto everything = [&] {
      field.displacements(places, out);
      for (const Place& p : places) {
        field.displacement(p.uvw, p.side, p.t);
        field.derivatives(p.uvw, p.side, p.t);
        field.quantity(0, p.uvw, p.side, p.t, stress);
        field.contract(p.uvw, p.side, 1e-3, history);
        evaluate(history, p.t);
        field.collapse(p.t, collapsed);
        collapsed.displacement(p.uvw, p.side);
      }
      collapsed.displacements(places, out);
    };
    for (const Kernel kernel : available_kernels()) {
      field.use(kernel);
      everything();
      const std::size_t before = allocations();
      everything();
      EXPECT_EQ(allocations(), before) << name_of(kernel);
    }
  }
}

}  // namespace cleft
