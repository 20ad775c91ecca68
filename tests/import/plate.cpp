#include "tests/import/plate.h"

#include <cmath>

namespace cleft {

Plate::Plate(Cells cells, const Pose& pose) : pose_(pose) {
  fill(cells);
  mesh_.times = {3, 3.5, 4.25, 5, 8};
}

std::int32_t Plate::node(const Vec3& p, int side_of_cell) {
  const int s = is_doubled(p) ? side_of_cell : 0;
  const auto [found, is_new] =
      numbers_.try_emplace({p.x, p.y, p.z, s}, static_cast<std::int32_t>(local.size()));
  if (is_new) {
    local.push_back(p);
    side.push_back(s);
    mesh_.add_point(pose_.point(p));
  }
  return found->second;
}

void Plate::fill(Cells kind) {
  static constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  static constexpr int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                      {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  // The right half first, so that neither a lower number nor an earlier cell means left.
  for (const double v : {0.0, 2.0, 4.0, -6.0, -4.0, -2.0})
    for (double u = -16; u < 16; u += 2)
      for (double w = -5; w < 0; ++w) {
        const int s = v < 0 ? -1 : 1;
        std::vector<std::int64_t> n;
        const auto place = [&](int c) {
          return Vec3{u + 2 * corner[c][0], v + 2 * corner[c][1], w + corner[c][2]};
        };
        for (int c = 0; c < 8; ++c) n.push_back(node(place(c), s));
        switch (kind) {
          case Cells::hexahedra:
            mesh_.add_cell(hexahedron, n);
            break;
          case Cells::wedges:
            mesh_.add_cell(wedge, {n[0], n[1], n[2], n[4], n[5], n[6]});
            mesh_.add_cell(wedge, {n[0], n[2], n[3], n[4], n[6], n[7]});
            break;
          case Cells::tetrahedra:  // around the diagonal 0-6
            for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
              mesh_.add_cell(tetra, {n[0], n[a], n[b], n[6]});
            break;
          case Cells::quadratic_hexahedra:
            for (const auto& [a, b] : edge) n.push_back(node(lerp(place(a), place(b), 0.5), s));
            mesh_.add_cell(quadratic_hexahedron, n);
            break;
        }
      }
}

Vec3 Plate::displacement(std::size_t n, std::size_t frame) const {
  const Vec3& p = local[n];
  const double t = static_cast<double>(frame);
  Vec3 d = {1e-3 * t * p.y, 2e-3 * t * p.x, 1e-3 * t * p.z * p.x};
  if (side[n] != 0 && is_open(p, frame)) d.y += side[n] * 0.01 * (tips[frame] - p.x) * (3 + p.z);
  return d;
}

std::vector<double> Plate::stress(std::size_t n, std::size_t frame) const {
  const Vec3& p = local[n];
  const double t = static_cast<double>(frame);
  return {p.x + t, p.y, p.z - t, 0.5 * p.x * p.y, 2 + t * p.z, 1 - p.x};
}

double Plate::temperature(std::size_t n, std::size_t frame) const {
  return 37 + local[n].x * static_cast<double>(frame) - local[n].z;
}

SourceSeries Plate::series() const {
  SourceSeries s = mesh_;
  s.fields = {{"displacement", 3, {}}, {"stress", 6, {}}, {"temperature", 1, {}}};
  for (std::size_t j = 0; j < frames; ++j) {
    for (SourceSeries::Field& field : s.fields) field.frames.emplace_back();
    for (std::size_t n = 0; n < local.size(); ++n) {
      const Vec3 d = pose_.vector(displacement(n, j));
      const std::vector<double> tensor = pose_.tensor(stress(n, j));
      s.fields[0].frames[j].insert(s.fields[0].frames[j].end(), {d.x, d.y, d.z});
      s.fields[1].frames[j].insert(s.fields[1].frames[j].end(), tensor.begin(), tensor.end());
      s.fields[2].frames[j].push_back(temperature(n, j));
    }
  }
  return s;
}

}  // namespace cleft
