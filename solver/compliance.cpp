#include "solver/compliance.h"

#include <math.h>  // isnan, which Boost 1.74 uses without saying so

#include <algorithm>
#include <array>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "base/error.h"
#include "solver/block_rows.h"

namespace cleft {

namespace {

/// The skin seen from above, to find the triangle of a point.
class Skin {
 public:
  explicit Skin(const PatchMesh& mesh) : mesh_(mesh) {}

  struct Place {
    std::array<int, 3> nodes;
    std::array<double, 3> weights;  // barycentric
  };

  /// The triangles that a square around a centre touches, in bins, so that few are tested for a point.
  class Near {
   public:
    Near(const Skin& skin, const Vec3& center, double radius)
        : skin_(skin), center_(center), radius_(radius) {
      std::vector<int> triangles;
      for (std::size_t t = 0; t < skin.mesh_.skin.size(); ++t)
        if (skin.touches(t, center.x - radius, center.x + radius, center.y - radius, center.y + radius))
          triangles.push_back(static_cast<int>(t));
      across_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(triangles.size()) / 2)));
      bins_.resize(across_ * across_);
      for (const int t : triangles) {
        const auto [u_least, u_most] = skin.range(skin.mesh_.skin[t], 0);
        const auto [v_least, v_most] = skin.range(skin.mesh_.skin[t], 1);
        for (int j = bin(v_least, center.y); j <= bin(v_most, center.y); ++j)
          for (int i = bin(u_least, center.x); i <= bin(u_most, center.x); ++i)
            bins_[j * across_ + i].push_back(t);
        const auto& corner = skin.mesh_.skin[t];
        for (int c = 0; c < 3; ++c) {
          const Vec3 &p = skin.mesh_.points[corner[c]], &q = skin.mesh_.points[corner[(c + 1) % 3]];
          shortest_edge_ = std::min(shortest_edge_, std::hypot(q.x - p.x, q.y - p.y));
        }
      }
    }

    bool find(double u, double v, Place& place) const {
      return skin_.find(bins_[bin(v, center_.y) * across_ + bin(u, center_.x)], u, v, place);
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
      const auto& corner = mesh_.skin[t];
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

/// Indices of lines from the middle to an edge, ascending: those nearest to the places that matter, closest
/// at the edge, where the compliance falls within a few millimetres, and where a disc begins to leave the
/// patch.
std::vector<int> lines_to_sample(const std::vector<double>& lines) {
  const int last = static_cast<int>(lines.size()) - 1;
  const auto nearest = [&](double place) {
    int best = last;
    for (int i = last; i >= 0 && lines[i] > -1e-9; --i)
      if (std::abs(lines[i] - place) < std::abs(lines[best] - place) - 1e-9) best = i;
    return best;
  };
  std::set<int> sampled = {nearest(0)};
  for (const double radii : {0., 0.5, 1., 2., 3.5})
    sampled.insert(nearest(std::max(0., lines.back() - radii * pressed_radius)));
  return {sampled.begin(), sampled.end()};
}

/// Monotone through points, constant beyond them; straight from one to the next where they are too few.
class Curve {
 public:
  Curve(const std::vector<double>& x, const std::vector<double>& y) : x_(x), y_(y) {
    if (x.size() >= 4) smooth_.emplace(std::vector<double>(x), std::vector<double>(y));
  }

  double operator()(double at) const {
    at = std::clamp(at, x_.front(), x_.back());
    if (smooth_) return (*smooth_)(at);
    std::size_t n = 1;
    while (n + 1 < x_.size() && x_[n] < at) ++n;
    return n < x_.size() ? std::lerp(y_[n - 1], y_[n], (at - x_[n - 1]) / (x_[n] - x_[n - 1])) : y_[0];
  }

 private:
  std::vector<double> x_, y_;
  std::optional<boost::math::interpolators::pchip<std::vector<double>>> smooth_;
};

/// Nodes to press on a quarter of the skin, and what is read off there. Where diagonals make a chess board, a
/// node gives way more or less than its neighbours by O(h^2), 1 % where h = 1 mm; the samples are freed of
/// that: a neighbour along the middle of the patch is pressed too for every line. (Stripes give next to
/// none.)
class Quarter {
 public:
  explicit Quarter(const PatchMesh& mesh) : mesh_(mesh) {
    std::vector<double> u, v;
    for (int i = 0; i < mesh.grid[0]; ++i) u.push_back(mesh.points[node(i, 0)].x);
    for (int j = 0; j < mesh.grid[1]; ++j) v.push_back(mesh.points[node(0, j)].y);
    us_ = lines_to_sample(u), vs_ = lines_to_sample(v);
    for (const int i : us_)
      for (const int j : vs_) nodes_.push_back(node(i, j));
    for (const int i : us_) nodes_.push_back(node(i, beside(vs_)));
    for (const int j : vs_) nodes_.push_back(node(beside(us_), j));
  }

  const std::vector<int>& nodes() const { return nodes_; }

  std::vector<double> at_node(std::vector<double> sampled) const {
    free_of_alternation(sampled);
    std::vector<Curve> along_v;  // at every sampled u
    for (std::size_t a = 0; a < us_.size(); ++a) {
      const auto first = sampled.begin() + static_cast<std::ptrdiff_t>(a * vs_.size());
      std::vector<double> places;
      for (const int j : vs_) places.push_back(mesh_.points[node(us_[a], j)].y);
      along_v.emplace_back(places,
                           std::vector<double>(first, first + static_cast<std::ptrdiff_t>(vs_.size())));
    }
    std::vector<double> places;
    for (const int i : us_) places.push_back(mesh_.points[node(i, 0)].x);
    std::vector<double> result(mesh_.points.size());
    std::vector<bool> known(mesh_.points.size(), false);
    for (std::size_t n = 0; n < result.size(); ++n) {
      const std::size_t above = mesh_.skin_above[n];
      if (!known[above]) {
        const Vec3& at = mesh_.points[above];
        std::vector<double> values;
        for (const Curve& curve : along_v) values.push_back(curve(std::abs(at.y)));
        result[above] = Curve(places, values)(std::abs(at.x));
        known[above] = true;
      }
      result[n] = result[above];
    }
    return result;
  }

 private:
  int node(int i, int j) const { return j * mesh_.grid[0] + i; }

  /// The line next to the middle one.
  static int beside(const std::vector<int>& lines) { return lines.front() - 1; }

  void free_of_alternation(std::vector<double>& sampled) const {
    const std::size_t nu = us_.size(), nv = vs_.size();
    if (beside(us_) == 0 || beside(vs_) == 0) return;  // an edge: no measure of it
    const auto part = [](double here, double there) { return (here - there) / (here + there); };
    std::vector<double> along_u, along_v;  // of the nodes on the middle lines
    for (std::size_t a = 0; a < nu; ++a) along_u.push_back(part(sampled[a * nv], sampled[nu * nv + a]));
    for (std::size_t b = 0; b < nv; ++b) along_v.push_back(part(sampled[b], sampled[nu * nv + nu + b]));
    for (std::size_t a = 0; a < nu; ++a)
      for (std::size_t b = 0; b < nv; ++b) {
        // What a node at (i, j) has more than its neighbours changes its sign from one to the next.
        const auto sign = [](int lines) { return lines % 2 == 0 ? 1 : -1; };
        const double u = along_u[a] * sign(vs_[b] - vs_[0]), v = along_v[b] * sign(us_[a] - us_[0]);
        const double middle = along_u[0] * sign(vs_[b] - vs_[0]) * sign(us_[a] - us_[0]);
        sampled[a * nv + b] /= 1 + u + v - middle;
      }
  }

  const PatchMesh& mesh_;
  std::vector<int> us_, vs_;  // lines
  std::vector<int> nodes_;    // all of us by vs, then those next to the middle
};

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
          if (const int row = system.row(system.unknown(place.nodes[i], 2)); row >= 0)
            loads(row, static_cast<Eigen::Index>(c)) -= area * place.weights[i];
        }
      }
    }
  }
  return loads;
}

Compliance compliance_of(const PatchMesh& mesh, const PatchSystem& system, FrameSolver& solver) {
  const Quarter quarter(mesh);
  std::vector<Vec3> centers = {mesh.start};
  for (const int n : quarter.nodes()) centers.push_back(mesh.points[n]);
  std::vector<double> sampled;
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
    const std::size_t pressed = std::max<std::size_t>(first, 1);
    for (std::size_t c = pressed; c < end; ++c) unknowns.push_back(system.unknown(quarter.nodes()[c - 1], 2));
    const Eigen::MatrixXd rows = gather_rows(system, block, unknowns);
    for (std::size_t c = pressed; c < end && system.rank() == 0; ++c)
      sampled.push_back(-rows(static_cast<Eigen::Index>(c - pressed), static_cast<Eigen::Index>(c - first)));
  }
  if (system.rank() == 0) result.at_node = quarter.at_node(std::move(sampled));
  return result;
}

}  // namespace cleft
