// Sums of histories.
#include "encoder/field/history.h"

#include <gtest/gtest.h>

namespace cleft {
namespace {

TEST(Histories, AddUpWhateverTheirBreaks) {
  const auto cubic = [](double a, double t) { return Vec3{a * t * t * t - t, a - t * t, 2 * a * t}; };
  // The same cubic in pieces of its own: Bezier controls by blossoms are those of any part of it.
  const auto history = [&](double a, std::vector<double> breaks) {
    History h;
    const double end = breaks.back();
    // Of the whole: from its values and slopes at 0 and at the end.
    const auto slope = [&](double t) { return Vec3{3 * a * t * t - 1, -2 * t, 2 * a}; };
    const std::array<Vec3, 4> whole{cubic(a, 0), cubic(a, 0) + end / 3 * slope(0),
                                    cubic(a, end) - end / 3 * slope(end), cubic(a, end)};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      h.controls.push_back(part_of_piece(whole, breaks[i] / end, breaks[i + 1] / end));
    h.breaks = std::move(breaks);
    return h;
  };
  const std::vector<History> parts{history(1, {0, 1, 2.5, 4}), history(-2, {0, 2.5, 3, 4}),
                                   history(3, {0, 4})};
  const std::vector<double> factors{0.5, 2, -1.5};
  History sum;
  combine(parts, factors, sum);
  EXPECT_EQ(sum.breaks, (std::vector<double>{0, 1, 2.5, 3, 4}));
  for (double t = 0; t <= 4; t += 0.1) {
    const Vec3 expected = 0.5 * cubic(1, t) + 2 * cubic(-2, t) - 1.5 * cubic(3, t);
    EXPECT_LT(norm(evaluate(sum, t) - expected), 1e-12 * 200) << t;
  }
}

}  // namespace
}  // namespace cleft
