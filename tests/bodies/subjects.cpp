#include "tests/bodies/subjects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace cleft::testing {

Vec3 flat(double x, double y) { return {x, y, 0}; }

Bend cylinder_along(double radius) {
  return [radius](double x, double y) -> Vec3 {
    return {x, radius * std::sin(y / radius), radius * std::cos(y / radius) - radius};
  };
}

Bend cylinder_around(double radius) {
  return [radius](double x, double y) -> Vec3 {
    return {radius * std::sin(x / radius), y, radius * std::cos(x / radius) - radius};
  };
}

Bend sphere_cap(double radius) {
  return [radius](double x, double y) -> Vec3 {
    const double r = std::hypot(x, y), part = r > 0 ? radius * std::sin(r / radius) / r : 1;
    return {part * x, part * y, radius * std::cos(r / radius) - radius};
  };
}

Bend saddle(double radius) {
  return [radius](double x, double y) -> Vec3 { return {x, y, (y * y - x * x) / (2 * radius)}; };
}

Bend torus_outside(double ring, double tube) {
  return [=](double x, double y) -> Vec3 {
    const double outer = ring + tube, r = ring + tube * std::cos(y / tube);
    return {r * std::sin(x / outer), tube * std::sin(y / tube), r * std::cos(x / outer) - outer};
  };
}

Bend ridge(double slope, double width) {
  return [=](double x, double y) -> Vec3 { return {x, y, -slope * (std::hypot(y, width) - width)}; };
}

Bend lamella(double half_width, double thickness) {
  return [=](double x, double y) -> Vec3 {
    const double r = thickness / 2, beyond = std::abs(y) - half_width, round = std::numbers::pi * r;
    double across = std::abs(y), z = 0;
    if (beyond > round)
      across = half_width - (beyond - round), z = -thickness;
    else if (beyond > 0)
      across = half_width + r * std::sin(beyond / r), z = r * std::cos(beyond / r) - r;
    return {x, std::copysign(across, y), z};
  };
}

Vec3 normal_of(const Bend& bend, double x, double y) {
  constexpr double step = 1e-4;
  return normalized(cross(bend(x + step, y) - bend(x - step, y), bend(x, y + step) - bend(x, y - step)));
}

SurfaceMesh sheet(const Bend& bend, double half_x, double half_y, double edge, double jitter, unsigned seed) {
  SurfaceMesh mesh;
  const int nx = std::max(1, static_cast<int>(std::lround(2 * half_x / edge)));
  const int ny = std::max(1, static_cast<int>(std::lround(2 * half_y / edge)));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> by(-jitter, jitter);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const bool within = 0 < i && i < nx && 0 < j && j < ny;
      const double dx = within ? by(random) : 0, dy = within ? by(random) : 0;
      mesh.points.push_back(bend(half_x * (2 * (i + dx) / nx - 1), half_y * (2 * (j + dy) / ny - 1)));
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

Bend below(const Bend& bend, const std::function<double(double, double)>& depth) {
  return [=](double x, double y) { return bend(x, y) - depth(x, y) * normal_of(bend, x, y); };
}

ScalpelPath path_on(const Bend& bend, const std::vector<std::pair<double, double>>& places, double depth,
                    double tilt) {
  std::vector<ScalpelPath::Point> points;
  const double angle = tilt * std::numbers::pi / 180;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = places[i];
    const auto [x0, y0] = places[i > 0 ? i - 1 : 0];
    const auto [x1, y1] = places[std::min(i + 1, places.size() - 1)];
    const Vec3 normal = normal_of(bend, x, y);
    const Vec3 along = bend(x1, y1) - bend(x0, y0), across = normalized(cross(normal, along));
    points.push_back({bend(x, y), std::cos(angle) * normal + std::sin(angle) * across, depth});
  }
  return ScalpelPath(points);
}

std::vector<std::pair<double, double>> arc(double radius, double length) {
  std::vector<std::pair<double, double>> places;
  const int pieces = std::max(8, static_cast<int>(std::ceil(length)));
  for (int i = 0; i <= pieces; ++i) {
    const double angle = length * (double(i) / pieces - 0.5) / radius;
    places.emplace_back(radius * std::sin(angle), radius - radius * std::cos(angle));
  }
  return places;
}

namespace {

/// So many mm along or across, about the middle.
std::vector<std::pair<double, double>> straight(double length, bool across = false) {
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i <= 8; ++i) {
    const double s = length * (i / 8. - 0.5);
    places.push_back(across ? std::pair{0., s} : std::pair{s, 0.});
  }
  return places;
}

}  // namespace

Subject small_subject(const std::string& name) {
  constexpr double half = 20, edge = 2, length = 9, depth = 2;
  const auto with = [&](const Bend& bend) {
    return Subject{name, sheet(bend, half, half, edge, 0.2), {path_on(bend, straight(length), depth)}, {}};
  };
  if (name == "axial") return with(cylinder_along(60));
  if (name == "around") return with(cylinder_around(60));
  if (name == "bent") return with(cylinder_around(30));
  if (name == "sphere") return with(sphere_cap(80));
  if (name == "plate" || name == "cross") {
    const Bend bend = name == "plate" ? Bend(flat) : sphere_cap(80);
    Subject subject = with(bend);
    subject.paths.push_back(path_on(bend, straight(length, true), depth));
    if (name == "plate") return subject;
    subject.bone = sheet(below(bend, [](double x, double) { return 4 + 0.2 * x; }), half, half, edge);
    return subject;
  }
  throw std::invalid_argument(name + ": no such subject");
}

}  // namespace cleft::testing
