#include "solver/compliance.h"

#include <math.h>  // isnan, which Boost 1.74 uses without saying so

#include <algorithm>
#include <array>
#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace cleft {

namespace {

/// The skin as seen from above, to find in which triangle a point lies.
class Skin {
 public:
  explicit Skin(const PatchMesh& mesh) : mesh_(mesh) {}

  struct Place {
    std::array<int, 3> nodes;
    std::array<double, 3> weights;  // barycentric
  };

  /// The triangles that a disc may touch.
  std::vector<int> near(const Vec3& center, double radius) const {
    std::vector<int> triangles;
    for (std::size_t t = 0; t < mesh_.skin.size(); ++t) {
      const auto [u_least, u_most] = range(mesh_.skin[t], 0);
      const auto [v_least, v_most] = range(mesh_.skin[t], 1);
      if (u_least <= center.x + radius && u_most >= center.x - radius && v_least <= center.y + radius &&
          v_most >= center.y - radius)
        triangles.push_back(static_cast<int>(t));
    }
    return triangles;
  }

  /// Whether one of the triangles holds the point, and where.
  bool find(const std::vector<int>& triangles, double u, double v, Place& place) const {
    constexpr double rounding = 1e-12;
    for (const int t : triangles) {
      const auto& corner = mesh_.skin[static_cast<std::size_t>(t)];
      const Vec3 &a = mesh_.points[corner[0]], &b = mesh_.points[corner[1]], &c = mesh_.points[corner[2]];
      const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      const double at_b = ((u - a.x) * (c.y - a.y) - (c.x - a.x) * (v - a.y)) / area;
      const double at_c = ((b.x - a.x) * (v - a.y) - (u - a.x) * (b.y - a.y)) / area;
      if (std::min({at_b, at_c, 1 - at_b - at_c}) < -rounding) continue;
      place = {corner, {1 - at_b - at_c, at_b, at_c}};
      return true;
    }
    return false;
  }

 private:
  std::pair<double, double> range(const std::array<int, 3>& corner, int axis) const {
    return std::minmax(
        {mesh_.points[corner[0]][axis], mesh_.points[corner[1]][axis], mesh_.points[corner[2]][axis]});
  }

  const PatchMesh& mesh_;
};

/// Places from the middle (0) to an edge, closest at the edge, where the compliance rises within a few
/// millimetres.
std::vector<double> places_to_edge(double edge) {
  std::vector<double> places = {edge};
  for (double step = 1; places.back() > 1.5 * step; step *= 1.7) places.push_back(places.back() - step);
  if (places.size() > 1 && places.back() < 1) places.pop_back();
  places.push_back(0);
  while (places.size() < 4) places.insert(places.begin() + 1, (places[0] + places[1]) / 2);
  std::reverse(places.begin(), places.end());
  return places;
}

using Curve = boost::math::interpolators::pchip<std::vector<double>>;

}  // namespace

Block disc_loads(const PatchMesh& mesh, const PatchSystem& system, std::span<const Vec3> centers) {
  // Exact in area: eight points along the radius by 32 around.
  using Radial = boost::math::quadrature::gauss<double, 8>;
  constexpr int around = 32;
  const Skin skin(mesh);
  Block loads = Block::Zero(system.owned(), static_cast<Eigen::Index>(centers.size()));
  for (std::size_t c = 0; c < centers.size(); ++c) {
    const std::vector<int> triangles = skin.near(centers[c], pressed_radius);
    const auto ring = [&](double x, double weight) {  // x in (-1, 1)
      const double r = pressed_radius * (1 + x) / 2;
      const double area = pressed_radius / 2 * weight * r * 2 * std::numbers::pi / around;
      for (int k = 0; k < around; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / around;
        Skin::Place place;
        if (!skin.find(triangles, centers[c].x + r * std::cos(angle), centers[c].y + r * std::sin(angle),
                       place))
          continue;
        for (int i = 0; i < 3; ++i) {
          const int local = system.unknown(place.nodes[i], 2) - system.first();
          if (local >= 0 && local < system.owned())
            loads(local, static_cast<Eigen::Index>(c)) -= area * place.weights[i];
        }
      }
    };
    for (std::size_t i = 0; i < Radial::abscissa().size(); ++i)
      for (const double x : {-Radial::abscissa()[i], Radial::abscissa()[i]}) ring(x, Radial::weights()[i]);
  }
  return loads;
}

Compliance compliance_of(const PatchMesh& mesh, const PatchSystem& system, FrameSolver& solver) {
  double edge_u = 0, edge_v = 0;
  for (const Vec3& p : mesh.points) edge_u = std::max(edge_u, p.x), edge_v = std::max(edge_v, p.y);
  const std::vector<double> us = places_to_edge(edge_u), vs = places_to_edge(edge_v);
  std::vector<Vec3> centers = {mesh.start};
  for (const double u : us)
    for (const double v : vs) centers.push_back({u, v, 0});

  const Skin skin(mesh);
  std::vector<std::vector<double>> sampled(us.size(), std::vector<double>(vs.size()));
  Compliance result;
  constexpr std::size_t at_once = 16;
  constexpr double enough = 1e-5;  // residual for a figure of an error of 1 %
  for (std::size_t first = 0; first < centers.size(); first += at_once) {
    const std::size_t end = std::min(centers.size(), first + at_once);
    solver.set_loads(disc_loads(mesh, system, std::span(centers).subspan(first, end - first)));
    std::vector<FrameSolver::Column> columns;
    for (std::size_t c = first; c < end; ++c)
      columns.push_back({static_cast<int>(c - first), 0, false, c == 0 ? 1e-10 : enough});
    const Block block = solver.solve(columns);
    if (first == 0) result.dent = block.leftCols(1);
    std::vector<int> unknowns;
    std::vector<Skin::Place> places(end - first);
    for (std::size_t c = first; c < end; ++c) {
      CLEFT_CHECK(skin.find(skin.near(centers[c], 0), centers[c].x, centers[c].y, places[c - first]), ==,
                  true);
      for (const int node : places[c - first].nodes) unknowns.push_back(system.unknown(node, 2));
    }
    const Eigen::MatrixXd rows = gather_rows(system, block, unknowns);
    for (std::size_t c = std::max<std::size_t>(first, 1); c < end && system.rank() == 0; ++c)
      for (int i = 0; i < 3; ++i)
        sampled[(c - 1) / vs.size()][(c - 1) % vs.size()] -=
            places[c - first].weights[i] *
            rows(static_cast<Eigen::Index>(3 * (c - first)) + i, static_cast<Eigen::Index>(c - first));
  }
  if (system.rank() != 0) return result;

  std::vector<Curve> along_v;  // at every sampled u
  for (auto& line : sampled) along_v.emplace_back(std::vector<double>(vs), std::move(line));
  result.at_node.resize(mesh.points.size());
  std::vector<bool> known(mesh.points.size(), false);
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const auto above = static_cast<std::size_t>(mesh.skin_above[n]);
    if (!known[above]) {
      const Vec3& at = mesh.points[above];
      std::vector<double> values;
      for (const Curve& curve : along_v) values.push_back(curve(std::min(std::abs(at.y), edge_v)));
      result.at_node[above] =
          Curve(std::vector<double>(us), std::move(values))(std::min(std::abs(at.x), edge_u));
      known[above] = true;
    }
    result.at_node[n] = result.at_node[above];
  }
  return result;
}

}  // namespace cleft
