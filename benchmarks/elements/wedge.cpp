#include "benchmarks/elements/wedge.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace cleft::elements {

namespace {

constexpr std::array<std::array<double, 2>, 3> slopes_of_corner = {{{-1, -1}, {1, 0}, {0, 1}}};

/// Collects functions that are products of one in the triangle and one along the axis.
struct Products {
  WedgeFunctions f;
  int next = 0;
  void add(double in_plane, double by_xi, double by_eta, double axial, double by_zeta) {
    f.value[next] = in_plane * axial;
    f.slope.row(next++) << by_xi * axial, by_eta * axial, in_plane * by_zeta;
  }
};

}  // namespace

WedgeFunctions wedge_functions(const WedgePoint& p, int count) {
  Products products{{Eigen::VectorXd(count), Eigen::MatrixX3d(count, 3)}};
  const std::array<double, 3> corner = {1 - p.xi - p.eta, p.xi, p.eta};
  const bool quadratic = count == 15;
  for (const double side : {-1., 1.})
    for (int c = 0; c < 3; ++c) {
      const double l = corner[c], half = 0.5 * (1 + side * p.zeta);
      const auto [x, e] = slopes_of_corner[c];
      if (!quadratic) {
        products.add(l, x, e, half, 0.5 * side);
        continue;
      }
      // l (2 l - 1) half - l (1 - zeta^2) / 2
      const double bubble = 1 - p.zeta * p.zeta, in_plane = l * (2 * l - 1), by_l = 4 * l - 1;
      products.f.value[products.next] = in_plane * half - 0.5 * l * bubble;
      const double slope = by_l * half - 0.5 * bubble;
      products.f.slope.row(products.next++) << slope * x, slope * e, in_plane * 0.5 * side + l * p.zeta;
    }
  if (!quadratic) return products.f;
  for (const double side : {-1., 1.})
    for (const auto [a, b] : {std::array{0, 1}, {1, 2}, {2, 0}}) {
      const double la = corner[a], lb = corner[b];
      const auto [xa, ea] = slopes_of_corner[a];
      const auto [xb, eb] = slopes_of_corner[b];
      products.add(4 * la * lb, 4 * (xa * lb + la * xb), 4 * (ea * lb + la * eb), 0.5 * (1 + side * p.zeta),
                   0.5 * side);
    }
  for (int c = 0; c < 3; ++c)
    products.add(corner[c], slopes_of_corner[c][0], slopes_of_corner[c][1], 1 - p.zeta * p.zeta, -2 * p.zeta);
  return products.f;
}

std::vector<std::array<double, 2>> gauss_rule(int n) {
  std::vector<std::array<double, 2>> rule;
  for (int k = 0; k < n; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 50; ++step) {
      double before = 1, value = x;
      for (int m = 2; m <= n; ++m)
        before = std::exchange(value, ((2 * m - 1) * x * value - (m - 1) * before) / m);
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

WedgeRules linear_rules() {
  return {{{0.5, 0, 1. / 6}, {0.5, 0.5, 1. / 6}, {0, 0.5, 1. / 6}}, gauss_rule(2)};
}

WedgeRules quadratic_rules() {
  constexpr double a = 0.445948490915965, b = 0.091576213509771;  // of degree 4 (Dunavant 1985)
  constexpr double of_a = 0.223381589678011 / 2, of_b = 0.109951743655322 / 2;
  WedgeRules rules{{}, gauss_rule(3)};
  for (const auto& [near, share] : {std::pair{a, of_a}, {b, of_b}})
    for (const auto& [xi, eta] : {std::pair{near, near}, {near, 1 - 2 * near}, {1 - 2 * near, near}})
      rules.triangle.push_back({xi, eta, share});
  return rules;
}

WedgeRules dense_rules(int n) {
  WedgeRules rules{{}, gauss_rule(n)};
  for (const auto& [s, ws] : rules.axis)
    for (const auto& [t, wt] : rules.axis) {
      const double r = (1 + s) / 2, part = (1 + t) / 2;
      rules.triangle.push_back({r * (1 - part), r * part, ws * wt * r / 4});
    }
  return rules;
}

}  // namespace cleft::elements
