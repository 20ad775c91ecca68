#include "tests/incision/stress/wedge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cleft::stress {

namespace {

double angle(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// The directions of the path's way over a triangle of the skin, along the straight piece of the lip on its
/// edge i; none where that is no lip of it.
std::vector<Vec3> directions(const CutMesh& mesh, int t, int i, const Incision& cut) {
  const CutMesh::Triangle& skin = mesh.triangle(t);
  const int wall = skin.neighbor[i];
  if (!mesh.is_wall(wall) || mesh.sheets()[mesh.triangle(wall).sheet].cut != cut.cut()) return {};
  const CutMesh::Triangle& w = mesh.triangle(wall);
  const double middle =
      (mesh.wall_s(wall, w.corner(skin.vertex[i])) + mesh.wall_s(wall, w.corner(skin.vertex[(i + 1) % 3]))) /
      2;
  const auto& chain = cut.chain();
  auto end = std::find_if(chain.begin() + 1, chain.end(), [&](const auto& c) { return c.s >= middle; });
  if (end == chain.end()) --end;
  const Vec3 n = cross(mesh.position(skin.vertex[1]) - mesh.position(skin.vertex[0]),
                       mesh.position(skin.vertex[2]) - mesh.position(skin.vertex[0]));
  constexpr int samples = 64;
  std::vector<Vec3> found;
  for (int k = 0; k <= samples; ++k) {
    const PathFrame frame = cut.path().at((end - 1)->s + (end->s - (end - 1)->s) * k / samples);
    found.push_back(frame.along - (dot(frame.along, n) / dot(frame.outward, n)) * frame.outward);
  }
  return found;
}

/// 4 sin(a/2) (1 - sin(a/2)): 8 sin(A/2) sin(B/2) sin(C/2) is largest where B = C.
double best_with(double angle) {
  const double sine = std::sin(std::min(angle, std::numbers::pi / 3) / 2);
  return 4 * sine * (1 - sine);
}

}  // namespace

double best_between_lips(const CutMesh& mesh, int triangle, const Incision& cut) {
  double best = 1;
  for (const int v : mesh.triangle(triangle).vertex) {
    const std::vector<int> fan = mesh.skin_fan(v);
    const int first = fan.front(), last = fan.back();
    const auto along = directions(mesh, first, mesh.triangle(first).corner(v), cut),
               other = directions(mesh, last, (mesh.triangle(last).corner(v) + 2) % 3, cut);
    if (along.empty() || other.empty()) continue;
    double wedge = 0;
    for (const int t : fan) {
      const auto& x = mesh.triangle(t);
      const int i = x.corner(v);
      wedge += angle(mesh.position(x.vertex[(i + 1) % 3]) - mesh.position(v),
                     mesh.position(x.vertex[(i + 2) % 3]) - mesh.position(v));
    }
    double turned = std::numbers::pi;
    for (const Vec3& a : along)
      for (const Vec3& b : other) turned = std::min({turned, angle(a, b), angle(a, -b)});
    best = std::min(best, best_with(std::max(wedge, turned)));
  }
  return best;
}

}  // namespace cleft::stress
