#include "benchmarks/elements/element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cleft::elements {

namespace {

constexpr std::array<std::array<double, 2>, 3> corner_at = {{{0, 0}, {1, 0}, {0, 1}}};
constexpr int dense = 6, densest = 10;  // points of rules along each direction

/// 3 n x 3 n products of slopes become the matrix of an isotropic material, in the first `axes` of three.
void add_isotropic(Eigen::MatrixXd& matrix, const Eigen::MatrixXd& products, double lambda, double mu,
                   int axes) {
  const Eigen::Index n = products.rows() / axes;
  const auto block = [&](int i, int j) { return products.block(i * n, j * n, n, n); };
  Eigen::MatrixXd trace = block(0, 0);
  for (int i = 1; i < axes; ++i) trace += block(i, i);
  for (int i = 0; i < axes; ++i)
    for (int j = 0; j < axes; ++j) {
      auto part = matrix.block(i * n, j * n, n, n);
      part += lambda * block(i, j) + mu * block(j, i);
      if (i == j) part += mu * trace;
    }
}

}  // namespace

Element::Element(const PatchNodes& nodes, std::array<Place, 6> corners, int side)
    : patch_(nodes), corners_(corners), side_(side) {
  // A front is at the first corner, where the dense rule is densest.
  const auto at_front = [&](int c) { return nodes.is_front(corners_[c]) || nodes.is_front(corners_[c + 3]); };
  for (int turn = 0; turn < 2 && !at_front(0); ++turn)
    for (const int first : {0, 3})
      std::rotate(corners_.begin() + first, corners_.begin() + first + 1, corners_.begin() + first + 3);
  for (const Place& corner : corners_) {
    numbers_.push_back(nodes.at(corner, side));
    points_.push_back(nodes.point(corner));
  }
  if (nodes.kind == Kind::enriched)
    for (int c = 0; c < 6; ++c)
      if (nodes.is_front(corners_[c])) {
        singular_.push_back(c);
        for (int f = 0; f < 4; ++f) numbers_.push_back(nodes.singular(corners_[c]) + f);
      }
  special_ = !singular_.empty();
  if (nodes.kind == Kind::linear || nodes.kind == Kind::enriched) return;
  for (const auto& [a, b] : edges_of_wedge) {
    Place middle;
    for (int axis = 0; axis < 3; ++axis) middle[axis] = (corners_[a][axis] + corners_[b][axis]) / 2;
    numbers_.push_back(nodes.at(middle, side));
    const bool moved =
        nodes.kind == Kind::quarter_points && nodes.is_front(corners_[a]) != nodes.is_front(corners_[b]);
    const double part = !moved ? 0.5 : nodes.is_front(corners_[a]) ? 0.25 : 0.75;
    points_.push_back((1 - part) * points_[a] + part * points_[b]);
    special_ = special_ || moved;
  }
}

Element::Functions Element::functions(const WedgePoint& point) const {
  const WedgeFunctions reference = wedge_functions(point, static_cast<int>(points_.size()));
  Functions f{reference.value, {}, Eigen::Matrix3d::Zero()};
  Vec3 place;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(n);
    for (int axis = 0; axis < 3; ++axis) f.jacobian.row(axis) += points_[n][axis] * reference.slope.row(row);
    place = place + f.value[row] * points_[n];
  }
  f.slope = reference.slope * f.jacobian.inverse();
  if (singular_.empty()) return f;
  const auto regular = f.value.size();
  const auto all = static_cast<Eigen::Index>(numbers_.size());
  f.value.conservativeResize(all);
  f.slope.conservativeResize(all, 3);
  Eigen::Index next = regular;
  for (const int c : singular_) {
    const Vec3 front = points_[c];
    // x ahead of the front, y across the cut.
    const bool end = patch_.is_end(corners_[c]);
    const int axis = end ? 0 : 2;
    const double ahead = end && corners_[c][0] == 2 * patch_.lines.last ? 1 : -1;
    const double x = ahead * (place[axis] - front[axis]), y = place.y;
    const double r = std::max(1e-300, std::hypot(x, y)), angle = side_ * std::atan2(std::abs(y), x);
    const double root = std::sqrt(r), s = std::sin(angle), k = std::cos(angle), s2 = std::sin(angle / 2),
                 k2 = std::cos(angle / 2);
    // sqrt(r) g(angle), with g and its derivative
    for (const auto& [g, dg] : {std::pair{s2, k2 / 2},
                                {k2, -s2 / 2},
                                {s2 * s, k2 * s / 2 + s2 * k},
                                {k2 * s, -s2 * s / 2 + k2 * k}}) {
      const double by_r = g / (2 * root), by_angle = dg / root;  // the second over r
      Eigen::RowVector3d slope = Eigen::RowVector3d::Zero();
      slope[axis] = ahead * (by_r * k - by_angle * s);
      slope[1] = by_r * s + by_angle * k;
      f.value[next] = f.value[c] * root * g;
      f.slope.row(next++) = f.slope.row(c) * (root * g) + f.value[c] * slope;
    }
  }
  return f;
}

bool Element::is_on(const std::array<int, 2>& edge, int axis, int line) const {
  return corners_[edge[0]][axis] == 2 * line && corners_[edge[1]][axis] == 2 * line;
}

Eigen::MatrixXd Element::stiffness(const Parameters& p) const {
  const auto n = static_cast<Eigen::Index>(numbers_.size());
  const WedgeRules rules = special_              ? dense_rules(singular_.empty() ? dense : densest)
                           : points_.size() == 6 ? linear_rules()
                                                 : quadratic_rules();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n), mass = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd slopes(3 * n, static_cast<Eigen::Index>(rules.triangle.size() * rules.axis.size()));
  Eigen::Index column = 0;
  for (const auto& [zeta, axial] : rules.axis)
    for (const auto& [xi, eta, weight] : rules.triangle) {
      const Functions f = functions({xi, eta, zeta});
      const double root = std::sqrt(f.jacobian.determinant() * weight * axial);
      slopes.col(column++) = root * f.slope.reshaped();
    }
  const double nu = p.tissue.poisson_ratio, mu = p.tissue.young_modulus / (2 * (1 + nu));
  add_isotropic(matrix, slopes * slopes.transpose(), 2 * mu * nu / (1 - 2 * nu), mu, 3);

  const auto area = [](const Functions& f) {
    return f.jacobian(0, 0) * f.jacobian(1, 1) - f.jacobian(0, 1) * f.jacobian(1, 0);
  };
  if (corners_[3][2] == 0) {
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    for (const auto& [xi, eta, weight] : rules.triangle) {
      const Functions f = functions({xi, eta, 1});
      const Eigen::VectorXd slope = f.slope.leftCols(2).reshaped();
      products += (weight * area(f)) * slope * slope.transpose();
    }
    const double skin_nu = p.skin.poisson_ratio, t_e = p.skin.thickness * p.skin.young_modulus;
    add_isotropic(matrix, products, t_e * skin_nu / (1 - skin_nu * skin_nu), t_e / (2 * (1 + skin_nu)), 2);
  }
  const auto& lines = patch_.lines;
  if (corners_[0][2] == 2 * (static_cast<int>(lines.w.size()) - 1))
    for (const auto& [xi, eta, weight] : rules.triangle) {
      const Functions f = functions({xi, eta, -1});
      mass += (p.foundation.stiffness * weight * area(f)) * f.value * f.value.transpose();
    }
  for (const auto& edge : {std::array{0, 1}, {1, 2}, {2, 0}}) {
    const bool at_side = is_on(edge, 0, 0) || is_on(edge, 0, static_cast<int>(lines.u.size()) - 1) ||
                         is_on(edge, 1, 0) || is_on(edge, 1, static_cast<int>(lines.v.size()) - 1);
    if (!at_side) continue;
    const Vec3 along = points_[edge[1]] - points_[edge[0]];
    for (const auto& [zeta, axial] : rules.axis)
      for (const auto& [s, weight] : rules.axis) {
        const double part = (1 + s) / 2;
        const auto [xa, ea] = corner_at[edge[0]];
        const auto [xb, eb] = corner_at[edge[1]];
        const Functions f = functions({xa + part * (xb - xa), ea + part * (eb - ea), zeta});
        const double face = norm(along) / 2 * f.jacobian(2, 2) * weight * axial;
        mass += (p.foundation.side_stiffness * face) * f.value * f.value.transpose();
      }
  }
  for (int axis = 0; axis < 3; ++axis) matrix.block(axis * n, axis * n, n, n) += mass;
  return matrix;
}

Eigen::VectorXd Element::released() const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers_.size()));
  if (corners_[3][2] != 0) return forces;
  for (const auto& edge : {std::array{0, 1}, {1, 2}, {2, 0}}) {
    const int a = corners_[edge[0]][0], b = corners_[edge[1]][0];
    if (!is_on(edge, 1, patch_.lines.plane) || std::min(a, b) < 2 * patch_.lines.first ||
        std::max(a, b) > 2 * patch_.lines.last)
      continue;
    const Eigen::Vector2d from(corner_at[edge[0]][0], corner_at[edge[0]][1]);
    const Eigen::Vector2d way = (Eigen::Vector2d(corner_at[edge[1]][0], corner_at[edge[1]][1]) - from) / 2;
    for (const auto& [s, weight] : gauss_rule(special_ ? 24 : 4)) {
      const Eigen::Vector2d at = from + (1 + s) * way;
      const Functions f = functions({at[0], at[1], 1});
      const double length = std::abs(f.jacobian.row(0).head<2>().dot(way));
      forces += (side_ * length * weight) * f.value;
    }
  }
  return forces;
}

}  // namespace cleft::elements
