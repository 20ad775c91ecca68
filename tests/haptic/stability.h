// A simulated hand that presses, slides, punctures, cuts and leaves, again and again, and what came of it.
#pragma once

#include "haptic/devices/hand.h"
#include "haptic/loop.h"
#include "tests/haptic/surfaces.h"

namespace cleft::testing {

struct Scenario {
  HandParameters hand;
  double stiffness = 0.3;                              ///< N/mm, of the tissue
  double puncture = ForceParameters{}.puncture_force;  ///< N
  bool passive = true;
};

struct Outcome {
  double created =
      0;  ///< N mm: most that the force did on the hand since a contact began, by the hand's count
  double observed = 0;       ///< the same by the loop's observer
  double largest_force = 0;  ///< N
  double excess_change = 0;  ///< N, beyond the permitted change a tick
  double early = 0,
         late = 0;  ///< mm: swing of a held tip, peak to peak, soon after it is held and 0.6 s later
  double work = 0;  ///< N mm, over the whole run
  int punctures = 0;
  std::uint64_t ticks = 0;
};

/// Every 6 s: press and hold below the threshold, slide, hold, press through, cut 20 mm, and leave.
inline std::vector<HandTarget> rounds(int count, double press) {
  std::vector<HandTarget> script;
  const auto at = [&](double time, double x, double z) {
    ScalpelPose pose;
    pose.tip = {x, 0.21, z};
    script.push_back({time, pose});
  };
  for (int k = 0; k < count; ++k) {
    const double t = 6. * k;
    at(t, -10, 3);
    at(t + 0.3, -10, -press);  // held until 1.8
    at(t + 1.8, -10, -press);
    at(t + 2.3, 5, -press);  // 15 mm in half a second, held until 3.8
    at(t + 3.8, 5, -press);
    at(t + 4.2, 5, -25);  // through
    at(t + 4.7, 25, -25);
    at(t + 5.0, 25, 3);
    at(t + 5.2, 25, 3);
    at(t + 5.7, -10, 4);
  }
  at(6. * count, -10, 3);
  return script;
}

inline Outcome run(const Scenario& scenario, int count) {
  static const Surface s =
      sheet(40, 2, [](double x, double y) { return 0.5 * std::sin(0.2 * x) * std::cos(0.2 * y); });
  const ContactSurface surface(s.points, s.triangles);
  ForceParameters p;
  p.stiffness = scenario.stiffness;
  p.puncture_force = scenario.puncture;
  // The grip and the tissue share the way: half the threshold at rest.
  const double k = scenario.hand.stiffness;
  const double press = 0.4 / scenario.stiffness + 0.4 / k;
  Hand hand(scenario.hand, rounds(count, press));
  LoopOptions options;
  options.passive = scenario.passive;
  HapticLoop loop(hand, surface, p, options);
  Outcome outcome;
  double begin = 0, low = 0, high = 0;
  int idle = 0;
  while (loop.state().time < hand.duration()) {
    loop.update(scenario.hand.period);
    const HapticState& state = loop.state();
    idle = state.force == Vec3{} ? idle + 1 : 0;
    if (idle > 80) begin = hand.work();
    outcome.created = std::max(outcome.created, hand.work() - begin);
    const double t = std::fmod(state.time, 6);
    for (const double from : {0.8, 1.4, 2.8, 3.4}) {
      if (t < from || t >= from + 0.35) continue;
      if (t < from + 1.5e-3) low = high = state.pose.tip.z;
      low = std::min(low, state.pose.tip.z), high = std::max(high, state.pose.tip.z);
      double& swing = from == 1.4 || from == 3.4 ? outcome.late : outcome.early;
      swing = std::max(swing, high - low);
    }
  }
  outcome.work = hand.work();
  outcome.observed = loop.passivity().created();
  outcome.largest_force = loop.statistics().largest_force;
  outcome.excess_change = loop.statistics().excess_change;
  outcome.punctures = loop.state().punctures;
  outcome.ticks = loop.state().tick;
  return outcome;
}

/// Whether a held tip keeps swinging: by more than a hundredth of a millimetre, and hardly less after 0.6 s.
inline bool cycles(const Outcome& o) { return o.late > 0.01 && o.late > 0.8 * o.early; }

/// Hands of several masses, grips and dampings, tissues of several stiffnesses, delays of 0 to 5 ms.
inline std::vector<Scenario> scenarios() {
  std::vector<Scenario> all;
  for (const double delay : {0., 1e-3, 2e-3, 5e-3})
    for (const double mass : {0.05, 0.1, 0.3})
      for (const double grip : {0.1, 0.4})
        for (const double damping : {0.002, 0.01})
          for (const double stiffness : {0.1, 0.4, 1.}) {
            Scenario s;
            s.hand.mass = mass, s.hand.stiffness = grip, s.hand.damping = damping, s.hand.delay = delay;
            s.hand.limits = {3.3, 1, 0.004, 0};
            s.stiffness = stiffness;
            all.push_back(s);
          }
  return all;
}

}  // namespace cleft::testing
