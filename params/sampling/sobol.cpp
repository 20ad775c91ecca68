#include <boost/random/sobol.hpp>
#include <random>

#include "params/sampling/sampling.h"

namespace cleft {

namespace {

/// What each coordinate's digits are xored with: any shift keeps the evenness of 2^k points.
std::vector<std::uint64_t> digital_shifts(std::size_t dimensions, std::uint64_t seed) {
  std::vector<std::uint64_t> shifts(dimensions, 0);
  std::mt19937_64 random(seed);
  if (seed != 0)
    for (std::uint64_t& shift : shifts) shift = random();
  return shifts;
}

}  // namespace

/// The first points of the Sobol sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30,
/// 2008), its origin included: more cases keep the earlier ones. A seed other than 0 shifts it digitally.
std::vector<Case> sample_sobol(const Study& study) {
  const std::vector<Variation> ranges = ranges_by_name(study);
  const std::vector<std::uint64_t> shifts = digital_shifts(ranges.size(), study.sampling.seed);
  boost::random::sobol sequence(ranges.size());
  std::vector<Case> cases(study.sampling.count, study.base);
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const std::uint64_t digits = i == 0 ? 0 : sequence();  // Boost leaves the origin out
      set_drawn(cases[i], ranges[k], unit_fraction(digits ^ shifts[k]), 1);
    }
  return cases;
}

}  // namespace cleft
