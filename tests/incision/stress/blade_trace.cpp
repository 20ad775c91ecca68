#include "tests/incision/stress/blade_trace.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "explorer/incision/blade.h"

namespace cleft::stress {

namespace {

/// The place nearest to `near` where the blade pierces one of some triangles, and in which.
struct Hit {
  int triangle = -1;
  Vec3 place;
  /// Whether the blade stands so upright that what moves it a little moves the place but a little.
  bool sound(const Ground& ground, const PathFrame& frame) const {
    return triangle >= 0 && dot(ground.face_normal(triangle), frame.outward) > 0.3;
  }
  void look(const CutMesh& mesh, int t, const PathFrame& frame, const Vec3& near) {
    if (!pierces(mesh, t, frame)) return;
    const Vec3 p = piercing_point(mesh, t, frame);
    if (triangle < 0 || squared_norm(p - near) < squared_norm(place - near)) triangle = t, place = p;
  }
};

/// Without what stands upright on the skin: lips lie on the surface as cutting has left it, the way on the
/// uncut.
double aside(const Vec3& d, const Vec3& outward) { return norm(d - dot(d, outward) * outward); }

/// Over edges from `from`, up to three triangles away.
Hit beside(const CutMesh& mesh, int from, const PathFrame& frame, const Vec3& near) {
  Hit hit;
  hit.look(mesh, from, frame, near);
  std::vector<int> seen{from};
  std::size_t first = 0;
  for (int ring = 0; ring < 4 && hit.triangle < 0; ++ring) {
    const std::size_t last = seen.size();
    for (; first < last; ++first)
      for (const int t : mesh.triangle(seen[first]).neighbor) {
        if (t < 0 || std::find(seen.begin(), seen.end(), t) != seen.end()) continue;
        seen.push_back(t);
        hit.look(mesh, t, frame, near);
      }
  }
  return hit;
}

}  // namespace

std::optional<double> blade_trace(const Ground& ground, const ScalpelPath& path, const Vec3& start,
                                  double from, const Vec3& end, double to) {
  constexpr int pieces = 1000;
  const double step = (to - from) / pieces;
  Hit at;
  for (int t = 0; t < static_cast<int>(ground.mesh.triangles().size()); ++t)
    at.look(ground.mesh, t, path.at(from + step / 2), start);
  if (!at.sound(ground, path.at(from + step / 2))) return std::nullopt;
  double length = aside(at.place - start, path.at(from).outward);
  for (int k = 1; k < pieces; ++k) {
    const PathFrame frame = path.at(from + (k + 0.5) * step);
    const Hit next = beside(ground.mesh, at.triangle, frame, at.place);
    if (!next.sound(ground, frame)) return std::nullopt;
    length += norm(next.place - at.place);
    at = next;
  }
  return length + aside(end - at.place, path.at(to).outward);
}

}  // namespace cleft::stress
