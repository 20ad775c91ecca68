#include "solver/shaped_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "base/wedge.h"
#include "params/parameters/table.h"
#include "solver/patch_shape.h"

namespace cleft {

namespace {

constexpr double least_in_plane = 0.1;     // of the determinant of the plane's map
constexpr double least_determinant = 0.1;  // of a wedge: least over mean Jacobian of its corners

/// "cut.curvature = 0.05 1/mm, patch.slope = 0.2": what is not that of a box.
std::string shape_of(const Parameters& p) {
  std::string text;
  const auto add = [&](const double& member) {
    if (member == 0) return;
    const Parameter& row = row_of(p, member);
    text += (text.empty() ? "" : ", ") + row.name + " = " + shortest(member) +
            (row.unit.empty() ? "" : " " + row.unit);
  };
  for (const double* member : {&p.cut.curvature, &p.cut.curvature_rate, &p.cut.tilt, &p.skin.curvature_u,
                               &p.skin.curvature_v, &p.skin.curvature_uv, &p.patch.slope})
    add(*member);
  return text;
}

std::string at(const Vec3& place) {
  const auto rounded = [](double x) { return shortest(std::round(10 * x) / 10); };
  return rounded(place.x) + ", " + rounded(place.y) + ", " + rounded(place.z);
}

class Shaper {
 public:
  Shaper(PatchMesh& mesh, const PatchGrid& grid, const std::vector<int>& grid_node, const Parameters& p)
      : mesh_(mesh), grid_(grid), grid_node_(grid_node), p_(p), shape_(p) {}

  void run() {
    set_coordinates();
    if (!is_shaped(p_)) return;
    move_nodes();
    set_tension();
    turn_normals();
    check_wedges();
  }

 private:
  struct Lines {
    int u, v, w;
  };
  Lines lines_of(std::size_t node) const {
    const int n = grid_node_[node], across = n / mesh_.grid[0];
    return {n % mesh_.grid[0], across % mesh_.grid[1], across / mesh_.grid[1]};
  }

  double depth(const Lines& at) const { return shape_.depth(grid_.v[at.v], grid_.w[at.w]); }

  /// Of the grid before it is moved onto a tilted blade: alike for all nodes of a column.
  void set_coordinates() {
    const int columns = mesh_.grid[0] * mesh_.grid[1];
    std::vector<std::array<double, 2>> places;
    std::vector<std::array<Vec3, 3>> frames;
    for (int n = 0; n < columns; ++n) {
      places.push_back(shape_.coordinates(grid_.u[n % mesh_.grid[0]], grid_.v[n / mesh_.grid[0]]));
      frames.push_back(shape_.frame(places.back()[0]));
    }
    for (std::size_t n = 0; n < mesh_.points.size(); ++n) {
      const Lines lines = lines_of(n);
      const std::size_t column = lines.v * mesh_.grid[0] + lines.u;
      mesh_.canonical.push_back({places[column][0], places[column][1], -depth(lines)});
      mesh_.frames.push_back(frames[column]);
    }
  }

  void move_nodes() {
    for (std::size_t n = 0; n < mesh_.points.size(); ++n) {
      const Lines lines = lines_of(n);
      const Vec3 box = mesh_.points[n];
      if (shape_.plane_determinant(box.x, box.y) < least_in_plane)
        throw InputError(shape_of(p_) +
                         ": the patch would fold beside the cut, at u, v = " + shortest(box.x) + ", " +
                         shortest(box.y) + " mm; make the curvature smaller, or the cut shorter");
      mesh_.points[n] = shape_.place(box.x, box.y, depth(lines));
      box_.push_back(box);
    }
    mesh_.start = shape_.place(mesh_.start.x, mesh_.start.y, 0);
  }

  void set_tension() {
    for (const auto& [a, b, c] : mesh_.skin) {
      const Vec3 centre = 1. / 3 * (box_[a] + box_[b] + box_[c]),
                 direction = shape_.tension(centre.x, centre.y);
      const std::vector<Vec3>& points = mesh_.points;
      const Vec3 normal = normalized(cross(points[b] - points[a], points[c] - points[a]));
      mesh_.tension.push_back(normalized(direction - dot(direction, normal) * normal));
    }
  }

  void turn_normals() {
    for (NodePair& pair : mesh_.pairs) {
      const auto& [along, across, outward] = mesh_.frames[pair.left];
      pair.normal = pair.normal.x * along + pair.normal.y * across + pair.normal.z * outward;
    }
  }

  void check_wedges() const {
    for (const auto& wedge : mesh_.wedges) {
      double least = std::numeric_limits<double>::infinity(), sum = 0;
      for (const double j : corner_determinants([&](int i) { return mesh_.points[wedge[i]]; }))
        least = std::min(least, j), sum += std::abs(j) / 6;
      if (!(least >= least_determinant * sum))
        throw InputError(shape_of(p_) + ": the elements at u, v, w = " + at(box_[wedge[0]]) +
                         " mm would be flat or turned over; make the curvatures or the slope smaller, or the "
                         "patch less high (patch.height = " +
                         shortest(p_.patch.height) + " mm)");
    }
  }

  PatchMesh& mesh_;
  const PatchGrid& grid_;
  const std::vector<int>& grid_node_;
  const Parameters& p_;
  const PatchShape shape_;
  std::vector<Vec3> box_;  // the nodes before they were moved
};

}  // namespace

void give_shape(PatchMesh& mesh, const PatchGrid& grid, const std::vector<int>& grid_node,
                const Parameters& parameters) {
  Shaper(mesh, grid, grid_node, parameters).run();
}

}  // namespace cleft
