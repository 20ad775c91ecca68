#include "tests/incision/stress/random_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.h"

namespace cleft::stress {

namespace {

constexpr double pi = std::numbers::pi;

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Start {
  int triangle;
  Vec3 place, heading;
};

Start random_start(const Ground& ground, std::mt19937_64& random) {
  const int t = static_cast<int>(random() % ground.mesh.triangles().size());
  double a = uniform(random, 0, 1), b = uniform(random, 0, 1);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  const auto& v = ground.mesh.triangle(t).vertex;
  const Vec3 p = ground.mesh.position(v[0]), e = ground.mesh.position(v[1]) - p,
             f = ground.mesh.position(v[2]) - p;
  const double angle = uniform(random, 0, 2 * pi);
  const Vec3 x = normalized(e), y = cross(ground.face_normal(t), x);
  return {t, p + a * e + b * f, std::cos(angle) * x + std::sin(angle) * y};
}

/// Curvature over the length (0 to 1), times the length.
double curvature(PathKind kind, double part, double amount) {
  switch (kind) {
    case PathKind::wavy:
    case PathKind::across:
      return amount * 6 * std::cos(4 * pi * part);
    case PathKind::spiral:
      return 2 * pi / (0.12 + 0.5 * part);
    case PathKind::eight: {  // two loops of three quarters each, crossing at a right angle
      const double at = std::abs(part - 0.5);
      return at > 0.1 && at < 0.4 ? std::copysign(1.5 * pi / 0.3, part - 0.5) : 0;
    }
    case PathKind::tiny:
      return amount * 4;
    default:
      return 0;
  }
}

using Points = std::vector<ScalpelPath::Point>;

Points walk(const Ground& ground, const Start& start, PathKind kind, double length, std::mt19937_64& random) {
  SurfaceWalker walker(ground, start.triangle, start.place, start.heading);
  const double edge = ground.edge_length(start.triangle);
  const double step = std::min(0.15 * edge, length / 48), depth = length * uniform(random, 0.05, 0.3);
  const double amount = uniform(random, -1, 1);
  Points points{{walker.place(), walker.normal(), depth}};
  int turn_in = 6;
  for (double way = step; way <= length; way += step) {
    walker.turn(curvature(kind, way / length, amount) * step / length);
    if (kind == PathKind::zigzag && --turn_in == 0) {
      walker.turn(uniform(random, -2, 2));
      turn_in = 4 + static_cast<int>(random() % 8);
    }
    const bool on = walker.go(step);
    points.push_back({walker.place(), walker.normal(), depth});
    if (on) continue;
    points.pop_back();
    if (walker.at_boundary())
      points.push_back({walker.place() + 0.5 * edge * walker.heading(), walker.normal(), depth});
    break;
  }
  if (kind == PathKind::off_surface) {  // next to the surface, tilted, and of varying depth
    const Vec3 tilt{uniform(random, -.3, .3), uniform(random, -.3, .3), uniform(random, -.3, .3)};
    const double off = uniform(random, -0.2, 0.2) * edge;
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].position += off * points[i].outward;
      points[i].outward = normalized(points[i].outward + tilt);
      points[i].depth *= 1 + double(i) / static_cast<double>(points.size());
    }
  }
  return points;
}

/// From vertex to vertex along edges; or next to them, by a little or by nothing that rounding would keep.
Points along_edges(const Ground& ground, PathKind kind, std::mt19937_64& random) {
  const Start start = random_start(ground, random);
  const double edge = ground.edge_length(start.triangle), depth = edge * uniform(random, 0.2, 2);
  const double offs[] = {1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.03};
  const double off = kind == PathKind::near_edges ? edge * offs[random() % 6] : 0;
  int v = ground.mesh.triangle(start.triangle).vertex[0];
  Vec3 heading = start.heading;
  Points points;
  const int count = 2 + static_cast<int>(random() % 12);
  std::set<int> visited;
  for (int i = 0; i <= count; ++i) {
    const Vec3 p = ground.mesh.position(v), n = ground.vertex_normals[v];
    points.push_back({p + off * cross(n, heading), n, depth});
    if (!visited.insert(v).second) break;  // on along its own lips there is nothing left to cut
    int best = -1;
    double straightest = -2;
    std::vector<int> fan;
    try {
      fan = ground.mesh.skin_fan(v);
    } catch (const InputError&) {
      break;
    }
    for (const int t : fan) {
      const int w = ground.mesh.triangle(t).vertex[(ground.mesh.triangle(t).corner(v) + 1) % 3];
      const double forward = dot(normalized(ground.mesh.position(w) - p), heading);
      if (forward > straightest) straightest = forward, best = w;
    }
    if (straightest < 0.5 || ground.mesh.on_boundary(v)) break;
    heading = normalized(ground.mesh.position(best) - p);
    v = best;
  }
  return points;
}

}  // namespace

std::string name_of(PathKind kind) {
  static const std::array<const char*, path_kinds> names{"straight",    "wavy",        "spiral",     "eight",
                                                         "zigzag",      "along edges", "near edges", "tiny",
                                                         "off surface", "across"};
  return names[static_cast<std::size_t>(kind)];
}

std::optional<ScalpelPath> random_path(const Ground& ground, PathKind kind,
                                       const std::optional<ScalpelPath>& earlier, std::mt19937_64& random) {
  Points points;
  if (kind == PathKind::along_edges || kind == PathKind::near_edges) {
    points = along_edges(ground, kind, random);
  } else {
    Start start = random_start(ground, random);
    const double edge = ground.edge_length(start.triangle);
    double length = edge * std::exp(uniform(random, std::log(2.), std::log(25.)));
    if (kind == PathKind::tiny) length = edge * uniform(random, 0.05, 0.5);
    if (kind == PathKind::eight || kind == PathKind::spiral) length = edge * uniform(random, 12, 60);
    if (kind == PathKind::across && earlier) {
      // To one side of a place of the earlier path, heading over it.
      const PathFrame frame = earlier->at(earlier->length() * uniform(random, -0.02, 1.02));
      int best = -1;
      double least = 1e300;
      for (std::size_t t = 0; t < ground.mesh.triangles().size(); ++t) {
        const auto& v = ground.mesh.triangles()[t].vertex;
        const Vec3 middle =
            1. / 3 * (ground.mesh.position(v[0]) + ground.mesh.position(v[1]) + ground.mesh.position(v[2]));
        const double distance = squared_norm(middle - frame.position);
        if (distance < least) least = distance, best = static_cast<int>(t);
      }
      const auto& v = ground.mesh.triangle(best).vertex;
      const Vec3 middle =
          1. / 3 * (ground.mesh.position(v[0]) + ground.mesh.position(v[1]) + ground.mesh.position(v[2]));
      const double angle = uniform(random, 0.2, pi - 0.2);
      SurfaceWalker back(ground, best, middle,
                         -(std::cos(angle) * frame.along + std::sin(angle) * frame.across));
      if (!back.go(length * uniform(random, 0.1, 0.9))) return std::nullopt;
      start = {back.triangle(), back.place(), -back.heading()};
    }
    points = walk(ground, start, kind, length, random);
  }
  if (points.size() < 3) return std::nullopt;
  try {
    const ScalpelPath path(points);
    // Begun at a fold that it cannot pass: no cut.
    const double edge = ground.edge_length(0);
    return path.length() < 1e-4 * edge ? std::nullopt : std::optional(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace cleft::stress
