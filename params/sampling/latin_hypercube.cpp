#include <numeric>
#include <random>

#include "params/sampling/sampling.h"

namespace cleft {

namespace {

/// 0 .. count - 1 in random order. std::shuffle would differ from one standard library to the next.
std::vector<std::size_t> random_order(std::size_t count, std::mt19937_64& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

/// Each range is divided into as many equal strata as there are cases; each stratum contains one case at a
/// random place (McKay, Beckman, Conover, Technometrics 21, 1979).
std::vector<Case> sample_latin_hypercube(const Study& study) {
  std::mt19937_64 random(study.sampling.seed);
  std::vector<Case> cases(study.sampling.count, study.base);
  for (const Variation& variation : ranges_by_name(study)) {
    const std::vector<std::size_t> strata = random_order(cases.size(), random);
    for (std::size_t i = 0; i < cases.size(); ++i)
      set_drawn(cases[i], variation, static_cast<double>(strata[i]) + unit_fraction(random()),
                static_cast<double>(cases.size()));
  }
  return cases;
}

}  // namespace cleft
