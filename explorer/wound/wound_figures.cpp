#include "explorer/wound/wound_figures.h"

#include <algorithm>

namespace cleft {

namespace {

/// Swept by a triangle that goes straight from its place on the left wall to that on the right one. Its area
/// vector is quadratic in the way, so that Simpson's rule is exact.
double swept_volume(const CutMesh& mesh, const CutMesh::Sheet& sheet, const std::vector<Vec3>& moved) {
  const auto place = [&](int triangle, int corner) {
    return moved[static_cast<std::size_t>(mesh.triangle(triangle).vertex[static_cast<std::size_t>(corner)])];
  };
  Vec3 left[3], way[3], mean;
  for (int i = 0; i < 3; ++i) {
    left[i] = place(sheet.left, i);
    way[i] = place(sheet.right, CutMesh::twin_corner(i)) - left[i];
    mean += (1. / 3) * way[i];
  }
  const auto area = [&](double part) {
    Vec3 x[3];
    for (int i = 0; i < 3; ++i) x[i] = left[i] + part * way[i];
    return 0.5 * cross(x[1] - x[0], x[2] - x[0]);
  };
  return dot(mean, (1. / 6) * (area(0) + 4 * area(0.5) + area(1)));
}

}  // namespace

std::vector<WoundFigures> wound_figures(const CutMesh& mesh,
                                        const std::vector<std::unique_ptr<Incision>>& cuts,
                                        const std::vector<Vec3>& moved) {
  std::vector<WoundFigures> all;
  for (const auto& cut : cuts) {
    WoundFigures& f = all.emplace_back();
    f.length = cut->path().length();
    constexpr int samples = 64;
    for (int i = 0; i <= samples; ++i) f.depth = std::max(f.depth, cut->path().depth(f.length * i / samples));
    double before = 0, at = 0;
    for (const Incision::ChainVertex& c : cut->chain()) {
      const double opening =
          norm(moved[static_cast<std::size_t>(c.right)] - moved[static_cast<std::size_t>(c.left)]);
      if (&c != &cut->chain().front()) f.area += 0.5 * (before + opening) * (c.s - at);
      if (opening > f.widest) f.widest = opening, f.widest_at = c.s;
      before = opening, at = c.s;
    }
    for (const CutMesh::Sheet& sheet : mesh.sheets())
      if (sheet.cut == cut->cut()) f.volume += swept_volume(mesh, sheet, moved);
  }
  return all;
}

}  // namespace cleft
