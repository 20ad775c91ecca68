// Functions of a wedge: linear ones, quadratic ones, and singular ones at the front of a cut.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace cleft::elements {

/// Corners: lower triangle, then upper. Middles of edges (of quadratic wedges): of the lower triangle's edges
/// 01, 12, 20, of the upper triangle's, then of the vertical ones.
inline constexpr std::array<std::array<int, 2>, 9> edges_of_wedge = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

/// Of the reference wedge: two coordinates in the triangle, the third from -1 (lower) to 1.
struct WedgePoint {
  double xi, eta, zeta;
};

/// Values and derivatives by the reference coordinates (columns) of 6 or 15 functions.
struct WedgeFunctions {
  Eigen::VectorXd value;
  Eigen::MatrixX3d slope;
};
WedgeFunctions wedge_functions(const WedgePoint& point, int count);

/// A rule in the triangle and one along the axis, with weights.
struct WedgeRules {
  struct InTriangle {
    double xi, eta, weight;
  };
  std::vector<InTriangle> triangle;
  std::vector<std::array<double, 2>> axis;
};
WedgeRules linear_rules();      ///< three points by two
WedgeRules quadratic_rules();   ///< six by three
WedgeRules dense_rules(int n);  ///< n by n by n, in the triangle denser toward its first corner

/// Points of a Gauss rule from -1 to 1, with weights.
std::vector<std::array<double, 2>> gauss_rule(int n);

}  // namespace cleft::elements
