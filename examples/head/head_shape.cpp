#include "examples/head/head_shape.h"

#include "examples/head/implicit.h"

namespace cleft::head {
namespace {

constexpr double neck_end = -140;

double skull(const Vec3& p) {
  double d = ellipsoid(p, {0, 33, -14}, {73, 73, 90});
  d = join(d, ellipsoid(p, {0, 32, 30}, {60, 52, 54}), 25);        // forehead
  d = join(d, ellipsoid(p, {0, -38, 30}, {54, 64, 52}), 25);       // face
  d = join(d, ellipsoid(p, {0, -62, 22}, {53, 34, 48}), 18);       // jaw
  d = join(d, capsule(p, {52, -22, 0}, {46, -65, 14}, 9, 9), 26);  // its angle
  d = join(d, ellipsoid(p, {41, -24, 50}, {18, 12, 22}), 18);      // cheekbone
  d = join(d, ellipsoid(p, {33, -50, 48}, {24, 28, 26}), 20);      // cheek
  return join(d, ellipsoid(p, {0, -91, 63}, {20, 15, 20}), 18);    // chin
}

double neck(const Vec3& p) {
  double d = capsule(p, {0, -40, -26}, {0, -190, -34}, 47, 50);
  return join(d, capsule(p, {52, -36, -26}, {14, -150, 16}, 9, 9), 16);  // the muscle from behind the ear
}

double brow_and_eye(double d, const Vec3& p) {
  d = join(d, capsule(p, {10, 14, 78}, {44, 12, 62}, 6, 5), 14);
  d = carve(d, ellipsoid(p, {31, -2, 92}, {19, 12, 17}), 14);
  d = join(d, ellipsoid(p, {32, -3, 64}, {15, 12.5, 14.5}), 5);  // the closed lid over the eyeball
  // The line between the lids hangs a little between the corners of the eye.
  const double s = (p.x - 32) / 15;
  const double off = norm({std::max(std::abs(p.x - 32) - 12, 0.), p.y + 8.5 - 3.5 * s * s, 0});
  return p.z < 50 ? d : d + 1.6 * groove(off, 1.7);
}

double nose(double d, const Vec3& p) {
  d = join(d, capsule(p, {0, 4, 70}, {0, -39, 82}, 9, 13.5), 12);
  d = join(d, capsule(p, {0, 8, 77}, {0, -33, 97}, 5.5, 7), 10);
  d = join(d, ellipsoid(p, {0, -37.5, 100}, {8.5, 7.5, 9}), 7);
  d = join(d, ellipsoid(p, {12, -41.5, 89}, {5.5, 6, 8.5}), 7);
  return carve(d, ellipsoid(p, {6, -49, 93}, {3, 4.5, 4.5}), 4);
}

double mouth(double d, const Vec3& p) {
  const double ax = std::abs(p.x);
  d = join(d, ellipsoid(p, {0, -66, 66}, {28, 19, 19}), 14);  // the teeth's bow below the lips
  d = join(d, capsule(p, {3.5, -63, 86.5}, {21, -67.5, 77}, 4.8, 1.8), 5);
  d = join(d, capsule(p, {0, -73, 85}, {18, -69, 77}, 5.8, 2.2), 5);
  if (p.z < 60) return d;
  const double line = norm({std::max(ax - 20, 0.), p.y + 67.5 + 0.004 * ax * ax - 0.06 * ax, 0});
  const double philtrum = norm({p.x, std::max(std::abs(p.y + 55) - 4, 0.), 0});
  return d + 1.8 * groove(line, 1.8) + 1.1 * groove(philtrum, 3);
}

double ear(double d, const Vec3& p) {
  // In the ear's own frame: a across it outwards, b up, c forward; it leans back and away from the skull.
  const Vec3 q = p - Vec3{73, -12, -14};
  const double lean = 0.2, off = 0.42;
  const double b = std::cos(lean) * q.y - std::sin(lean) * q.z,
               c0 = std::sin(lean) * q.y + std::cos(lean) * q.z;
  const Vec3 e{std::cos(off) * q.x + std::sin(off) * c0, b, -std::sin(off) * q.x + std::cos(off) * c0};
  double shell = ellipsoid(e, {0, 3, -4}, {6, 30, 18});
  shell = join(shell, ellipsoid(e, {0, -23, 2}, {5, 9, 8}), 8);  // lobe
  shell = carve(shell, ellipsoid(e, {8.5, 6, -3}, {6, 19, 9.5}), 4);
  shell = carve(shell, ellipsoid(e, {7.5, -6, 1}, {7, 9, 7}), 4);  // concha
  shell = join(shell, ellipsoid(e, {2, -6, 11}, {5, 6, 4}), 4);    // tragus
  return join(d, shell, 5);
}

}  // namespace

double distance(const Vec3& point) {
  const Vec3 p{std::abs(point.x), point.y, point.z};  // every part is given on the left side
  double d = join(skull(p), neck(p), 16);
  d = brow_and_eye(d, p);
  d = nose(d, p);
  d = mouth(d, p);
  d = ear(d, p);
  return -join(-d, p.y - neck_end, 14);
}

Vec3 gradient(const Vec3& p) {
  constexpr double h = 1e-4;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    Vec3 a = p, b = p;
    a[i] -= h, b[i] += h;
    g[i] = (distance(b) - distance(a)) / (2 * h);
  }
  return g;
}

Vec3 project(Vec3 p) {
  for (int step = 0; step < 30; ++step) {
    const double d = distance(p);
    if (std::abs(d) < 1e-9) break;
    const Vec3 g = gradient(p);
    p -= std::clamp(d, -4., 4.) / squared_norm(g) * g;
  }
  return p;
}

double relative_edge_length(const Vec3& point) {
  const Vec3 p{std::abs(point.x), point.y, point.z};
  const auto near = [&p](const Vec3& center, const Vec3& r) {
    const double a = std::max(ellipsoid(p, center, r), 0.) / 25;
    return std::exp(-a * a);
  };
  double length = 1;
  const auto want = [&length](double wanted, double weight) {
    length = std::min(length, 1 + (wanted - 1) * weight);
  };
  want(0.55, near({0, -40, 70}, {50, 65, 40}));   // face
  want(0.42, near({50, -58, 48}, {16, 26, 20}));  // cheeks, which are to be cut
  want(0.25, near({32, -5, 78}, {17, 8, 12}));    // eyes
  want(0.3, near({0, -40, 100}, {12, 14, 12}));   // nose
  want(0.27, near({0, -67, 88}, {24, 8, 10}));    // mouth
  want(0.6, std::exp(-std::pow((p.y - neck_end) / 12, 2)));
  want(0.4, near({78, -12, -18}, {8, 30, 18}));  // ears
  return length;
}

Box bounds() { return {{-105, neck_end - 6, -115}, {105, 115, 125}}; }

std::vector<PathPoint> cheek_path(double step) {
  const Vec3 a{60, -33, 32}, b{60, -65, 46}, c{35, -77, 68};
  const auto on_skin = [&](double s) { return project(lerp(lerp(a, b, s), lerp(b, c, s), s)); };
  std::vector<PathPoint> path;
  // Walk the curve in small steps and keep a point at every multiple of `step` of the length walked.
  constexpr int pieces = 4000;
  double walked = 0;
  Vec3 previous = on_skin(0);
  for (int i = 0; i <= pieces; ++i) {
    const Vec3 p = on_skin(double(i) / pieces);
    walked += norm(p - previous);
    previous = p;
    if (walked >= path.size() * step) path.push_back({p, normalized(gradient(p))});
  }
  return path;
}

}  // namespace cleft::head
