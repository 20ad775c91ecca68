// haptic-stability [ROUNDS]: every scenario for so many rounds of 6,000 ticks; 12 are 10^7 ticks in all.
#include <cstdio>
#include <cstdlib>

#include "tests/haptic/stability.h"

using namespace cleft::testing;

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 12;
  std::uint64_t ticks = 0;
  Outcome worst;
  int limit_cycles = 0;
  std::printf(
      "delay ms  mass kg  grip  damping  tissue  created N mm  observed  force N  excess N  early mm  late "
      "mm  work  "
      "punctures\n");
  for (const Scenario& s : scenarios()) {
    const Outcome o = run(s, rounds);
    ticks += o.ticks;
    worst.created = std::max(worst.created, o.created);
    worst.largest_force = std::max(worst.largest_force, o.largest_force);
    worst.excess_change = std::max(worst.excess_change, o.excess_change);
    std::printf("%8.0f %8.2f %5.1f %8.3f %7.1f %13.4f %9.4f %8.2f %9.4f %9.4f %8.4f %8.1f %5d%s\n",
                1e3 * s.hand.delay, s.hand.mass, s.hand.stiffness, s.hand.damping, s.stiffness, o.created,
                o.observed, o.largest_force, o.excess_change, o.early, o.late, o.work, o.punctures,
                cycles(o) ? " cycles" : "");
    limit_cycles += cycles(o);
  }
  const bool safe = worst.created <= 0.05 && worst.largest_force <= 3.3 * (1 + 1e-12) &&
                    worst.excess_change <= 0 && limit_cycles == 0;
  std::printf(
      "%llu ticks: created at most %.4f N mm, force at most %.2f N, excess change %.2g N, %d limit cycles\n",
      static_cast<unsigned long long>(ticks), worst.created, worst.largest_force, worst.excess_change,
      limit_cycles);
  return safe ? 0 : 1;
}
