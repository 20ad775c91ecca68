#include "solver/compliance.h"

#include <math.h>  // isnan, which Boost 1.74 uses without saying so

#include <algorithm>
#include <array>
#include <boost/math/interpolators/pchip.hpp>
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

  /// The triangles that a square about a centre touches, in bins, so that few are looked at for a point.
  class Near {
   public:
    Near(const Skin& skin, const Vec3& center, double radius)
        : skin_(skin), center_(center), radius_(radius) {
      std::vector<int> triangles;
      for (std::size_t t = 0; t < skin.mesh_.skin.size(); ++t)
        if (skin.touches(t, center.x - radius, center.x + radius, center.y - radius, center.y + radius))
          triangles.push_back(static_cast<int>(t));
      across_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(triangles.size()) / 2)));
      bins_.resize(static_cast<std::size_t>(across_ * across_));
      for (const int t : triangles) {
        const auto [u_least, u_most] = skin.range(skin.mesh_.skin[static_cast<std::size_t>(t)], 0);
        const auto [v_least, v_most] = skin.range(skin.mesh_.skin[static_cast<std::size_t>(t)], 1);
        for (int j = bin(v_least, center.y); j <= bin(v_most, center.y); ++j)
          for (int i = bin(u_least, center.x); i <= bin(u_most, center.x); ++i)
            bins_[static_cast<std::size_t>(j * across_ + i)].push_back(t);
        const auto& corner = skin.mesh_.skin[static_cast<std::size_t>(t)];
        for (int c = 0; c < 3; ++c) {
          const Vec3 &p = skin.mesh_.points[corner[c]], &q = skin.mesh_.points[corner[(c + 1) % 3]];
          shortest_edge_ = std::min(shortest_edge_, std::hypot(q.x - p.x, q.y - p.y));
        }
      }
    }

    bool find(double u, double v, Place& place) const {
      return skin_.find(bins_[static_cast<std::size_t>(bin(v, center_.y) * across_ + bin(u, center_.x))], u,
                        v, place);
    }

    double shortest_edge() const { return shortest_edge_; }

   private:
    int bin(double x, double middle) const {
      if (radius_ == 0) return 0;
      const double part = (x - middle + radius_) / (2 * radius_);
      return std::clamp(static_cast<int>(std::floor(part * across_)), 0, across_ - 1);
    }

    const Skin& skin_;
    Vec3 center_;
    double radius_, shortest_edge_ = 2 * pressed_radius;
    int across_ = 1;
    std::vector<std::vector<int>> bins_;
  };

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
  bool touches(std::size_t t, double u_from, double u_to, double v_from, double v_to) const {
    const auto [u_least, u_most] = range(mesh_.skin[t], 0);
    const auto [v_least, v_most] = range(mesh_.skin[t], 1);
    return u_least <= u_to && u_most >= u_from && v_least <= v_to && v_most >= v_from;
  }

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
  const Skin skin(mesh);
  Block loads = Block::Zero(system.owned(), static_cast<Eigen::Index>(centers.size()));
  for (std::size_t c = 0; c < centers.size(); ++c) {
    const Skin::Near near(skin, centers[c], pressed_radius);
    // Rings in pairs of Gauss points, which is exact in area; points a third of the least edge apart.
    const double apart = near.shortest_edge() / 3;
    const int pairs = std::clamp(static_cast<int>(std::ceil(pressed_radius / apart / 2)), 4, 20);
    const double eighth =
        2 * std::numbers::pi * pressed_radius / apart / 8;  // so that the points are as symmetric
    const int around = 8 * std::clamp(static_cast<int>(std::ceil(eighth)), 4, 32);
    const double width = pressed_radius / pairs;
    for (int ring = 0; ring < 2 * pairs; ++ring) {
      const double r = width * (ring / 2 + 0.5 + (ring % 2 - 0.5) / std::numbers::sqrt3);
      const double area = width / 2 * r * 2 * std::numbers::pi / around;
      for (int k = 0; k < around; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / around;
        Skin::Place place;
        if (!near.find(centers[c].x + r * std::cos(angle), centers[c].y + r * std::sin(angle), place))
          continue;
        for (int i = 0; i < 3; ++i) {
          const int local = system.unknown(place.nodes[i], 2) - system.first();
          if (local >= 0 && local < system.owned())
            loads(local, static_cast<Eigen::Index>(c)) -= area * place.weights[i];
        }
      }
    }
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
      CLEFT_CHECK(Skin::Near(skin, centers[c], 0).find(centers[c].x, centers[c].y, places[c - first]), ==,
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
