#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/text.h"
#include "haptic/devices/recorded.h"
#include "haptic/loop.h"
#include "tradeoff/measures.h"

namespace cleft {

namespace {

constexpr double reference_rate = 8000, duration = 4;
constexpr std::array<double, 5> rates = {125, 250, 500, 1000, 2000};

/// A wavy sheet of 80 mm, triangles of 2 mm.
ContactSurface tissue() {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  constexpr int n = 40;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 2 * i - n, y = 2 * j - n;
      points.push_back({x, y, 0.5 * std::sin(0.2 * x) * std::cos(0.2 * y)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      triangles.push_back({a, a + 1, b + 1}), triangles.push_back({a, b + 1, b});
    }
  return ContactSurface(points, triangles);
}

/// A smooth way from a to b between two times.
double eased(double t, double from, double to, double a, double b) {
  const double x = std::clamp((t - from) / (to - from), 0.0, 1.0);
  return a + (b - a) * x * x * (3 - 2 * x);
}

/// The tip of a blade that presses, slides, trembling at 5 Hz, and leaves.
Vec3 tip_at(double t) {
  const double down = eased(t, 0.2, 0.8, 1, -1.8), up = eased(t, 3.2, 3.8, 0, 3);
  const double tremble = t > 1 && t < 3 ? 0.3 * std::sin(10 * std::numbers::pi * (t - 1)) : 0;
  return {eased(t, 1, 3, -15, 15), 0.3, down + up + tremble};
}

/// The force held at each of the reference's ticks, N.
std::vector<Vec3> forces_at(const ContactSurface& surface, double rate, bool passive) {
  std::vector<RecordedPose> poses;
  for (int i = 0; i <= static_cast<int>(duration * rate); ++i) {
    const double t = i / rate;
    ScalpelPose pose;
    pose.tip = tip_at(t), pose.cutting = false;
    poses.push_back({t, pose});
  }
  Recorded device(poses);
  LoopOptions options;
  options.rate = rate, options.passive = passive;
  HapticLoop loop(device, surface, ForceParameters{}, options);
  const int held = static_cast<int>(reference_rate / rate);
  std::vector<Vec3> forces;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    loop.update(1 / rate);
    forces.insert(forces.end(), static_cast<std::size_t>(held), loop.state().force);
  }
  forces.resize(duration * reference_rate);
  return forces;
}

}  // namespace

std::vector<Chart> haptic_charts(const ChartOptions& options) {
  options.progress("pressing and sliding a blade");
  Chart chart{"haptic.rate", "Force: error over update rate", "ticks a second, Hz",
              "largest error of the force / largest force"};
  chart.front = false;
  const ContactSurface surface = tissue();
  const std::vector<Vec3> truth = forces_at(surface, reference_rate, false);
  double largest = 0;
  for (const Vec3& f : truth) largest = std::max(largest, norm(f));
  for (const bool passive : {false, true})
    for (const double rate : rates) {
      const std::vector<Vec3> forces = forces_at(surface, rate, passive);
      double error = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) error = std::max(error, norm(forces[i] - truth[i]));
      chart.points.push_back({passive ? "as rendered" : "model alone", shortest(rate) + " Hz", rate,
                              error / largest, passive && rate == LoopOptions{}.rate});
    }
  return {chart};
}

}  // namespace cleft
