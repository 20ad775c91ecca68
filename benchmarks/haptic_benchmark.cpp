// What the haptic thread's questions and the surface's changes cost, at 12,000, 100,000 and 1,000,000
// triangles. cleft-benchmark-haptic             prints medians and tails, nanoseconds cleft-benchmark-haptic
// --check     a million random queries against brute force: 0 where all agree
#include <chrono>
#include <cstdio>
#include <string>
#include <tuple>

#include "base/quantiles.h"
#include "tests/haptic/surfaces.h"

using namespace cleft;
using testing::Surface;

namespace {

double kept = 0;  // keeps the compiler from leaving out what is measured

/// Nanoseconds of a call, over groups of `together` calls.
template <class Function>
std::vector<double> nanoseconds(int groups, int together, const Function& function) {
  std::vector<double> times;
  int n = 0;
  for (int g = 0; g < groups; ++g) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < together; ++k) function(n++);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count() / together);
  }
  return times;
}

void print(const char* what, std::vector<double> times) {
  const double p50 = quantile(times, 0.5), p99 = quantile(times, 0.99), p999 = quantile(times, 0.999);
  std::printf("  %-44s %8.0f %8.0f %8.0f\n", what, p50, p99, p999);
}

/// A tool that circles the ball, 50 mm/s at 1 kHz, 0.5 mm in and out of its surface.
Vec3 tool_at(int tick) {
  const double a = 1.57 + 0.3 * std::sin(1e-4 * tick), b = 0.0005 * tick;
  return (100 + 0.5 * std::sin(0.05 * tick)) *
         Vec3{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

void queries(ContactReader& reader) {
  std::vector<Vec3> tool(200002);
  for (std::size_t n = 0; n < tool.size(); ++n) tool[n] = tool_at(static_cast<int>(n));
  const auto at = [&](int n) -> const Vec3& { return tool[n]; };
  const ContactLook look(reader);
  print("first contact of a tick's way", nanoseconds(20000, 10, [&](int n) {
          kept += reader.first_contact(at(n), at(n + 1), Facing::any).fraction;
        }));
  print("first contact of a blade of 5 mm", nanoseconds(20000, 10, [&](int n) {
          kept += reader.first_contact(1.05 * at(n), at(n), Facing::any).fraction;
        }));
  print("nearest point within 1 mm",
        nanoseconds(20000, 10, [&](int n) { kept += reader.nearest(at(n), 1).distance; }));
  SurfaceProxy proxy;
  print("proxy", nanoseconds(20000, 10, [&](int n) {
          const Vec3 x = 0.99 * at(n);
          if (!proxy) {
            const NearestPoint p = reader.nearest(x, 5);
            proxy = {p.triangle, -p.distance, p.position, p.normal};
          }
          proxy = reader.proxy(x, proxy);
          kept += proxy.depth;
        }));
}

/// Steps like those of a cut: two triangles become four, a column of walls below, some skin moves.
void updates(Surface s, ContactSurface& surface) {
  std::vector<ContactSurface::Moved> moved;
  std::vector<ContactSurface::Changed> changed;
  const auto add = [&](const Vec3& p) {
    moved.push_back({static_cast<int>(s.points.size()), p});
    s.points.push_back(p);
    return moved.back().vertex;
  };
  std::vector<double> times;
  std::size_t touched = 0;
  const std::size_t original = s.triangles.size();
  for (int step = 0; step < 300; ++step) {
    moved.clear(), changed.clear();
    const auto first = original / 4 + 2 * static_cast<std::size_t>(step);
    for (std::size_t t = first; t < first + 2; ++t) {
      const Corners c = testing::corners(s, t);
      const auto [a, b, d] = s.triangles[t];
      const int m = add(1 / 3. * (c[0] + c[1] + c[2]));
      const auto put = [&](std::size_t at, std::array<int, 3> corner, bool wall) {
        changed.push_back({static_cast<int>(at), {corner, wall}});
        if (at == s.triangles.size()) s.triangles.push_back(corner);
        s.triangles[at] = corner;
      };
      put(t, {a, b, m}, false);
      put(s.triangles.size(), {b, d, m}, false);
      put(s.triangles.size(), {d, a, m}, false);
      const double h = norm(c[1] - c[0]);
      int left = a, right = b;
      for (int row = 1; row <= 3; ++row) {  // a wall of three rows
        const int l = add((1 - row * h / 100) * c[0]), r = add((1 - row * h / 100) * c[1]);
        put(s.triangles.size(), {left, right, r}, true);
        put(s.triangles.size(), {left, r, l}, true);
        left = l, right = r;
      }
    }
    const auto start = std::chrono::steady_clock::now();
    surface.update(moved, changed);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count());
    touched += changed.size();
    surface.prepare();
  }
  char what[80];
  std::snprintf(what, sizeof what, "update after a cut step (%.0f triangles)",
                static_cast<double>(touched) / 300);
  print(what, times);
}

int check(long count) {
  const Surface s = testing::ball(12, 10, 0.1);
  const ContactSurface surface(s.points, s.triangles);
  ContactReader reader(surface);
  const ContactLook look(reader);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-14, 14);
  long wrong = 0, met = 0;
  for (long n = 0; n < count; ++n) {
    const Vec3 from{along(random), along(random), along(random)};
    Vec3 to{along(random), along(random), along(random)};
    if (n % 3) to = lerp(from, to, 0.1);
    const auto expected = testing::brute_first_contact(s, from, to, Facing::any);
    const SurfaceHit hit = reader.first_contact(from, to, Facing::any);
    const double distance = testing::brute_distance(s, from);
    const NearestPoint nearest = reader.nearest(from, 2);
    met += bool(hit);
    if (expected.margin >= 1e-9)
      wrong +=
          bool(hit) != (expected.fraction <= 1) || (hit && std::abs(hit.fraction - expected.fraction) > 1e-9);
    wrong += bool(nearest) != (distance <= 2) ||
             (nearest && std::abs(std::abs(nearest.distance) - distance) > 1e-12);
  }
  std::printf("%ld queries of each kind, %ld segments met the surface, %ld wrong\n", count, met, wrong);
  return wrong != 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--check") return check(1000000);
  for (const int rings : {54, 158, 500}) {
    const Surface s = testing::ball(rings, 100);
    const auto start = std::chrono::steady_clock::now();
    ContactSurface surface(s.points, s.triangles);
    const std::chrono::duration<double, std::milli> made = std::chrono::steady_clock::now() - start;
    std::printf("%zu triangles: made in %.0f ms; nanoseconds      p50      p99    p99.9\n",
                s.triangles.size(), made.count());
    ContactReader reader(surface);
    queries(reader);
    updates(s, surface);
  }
  return kept == 12345.678;
}
