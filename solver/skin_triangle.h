// A constant-strain triangle of skin: a membrane in plane stress that carries a prestress and no bending.
// Paper, section 3.1.
#pragma once

#include <Eigen/Core>

#include "base/vec3.h"
#include "solver/material/skin_material.h"

namespace cleft {

/// The triangle is in a plane w = const with the directions u and v; its only stiffness along w is that of
/// the prestress.
class SkinTriangle {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Matrix63 = Eigen::Matrix<double, 6, 3>;

  /// Of the three corners.
  SkinTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
      : area_(norm(cross(b - a, c - a)) / 2), strain_(strain_of(a, b, c)) {}

  double area() const { return area_; }  ///< mm^2

  /// Of the shape functions of the corners, in u and v, 1/mm.
  Eigen::Matrix<double, 2, 3> gradients() const {
    Eigen::Matrix<double, 2, 3> gradient;
    for (int i = 0; i < 3; ++i) gradient.col(i) << strain_(0, 2 * i), strain_(1, 2 * i + 1);
    return gradient;
  }

  /// t A B^T D B over (u, v) of the three corners.
  Matrix6 stiffness(const SkinMaterial& skin) const {
    return skin.thickness * area_ * strain_.transpose() * skin.elasticity * strain_;
  }

  /// Loads of the unit prestresses uu, vv, uv on (u, v) of the corners: -t A B^T, one in each column.
  Matrix63 unit_loads(const SkinMaterial& skin) const {
    return -skin.thickness * area_ * strain_.transpose();
  }

  /// Geometric stiffness of the prestress between the corners, equal for the three directions:
  /// t A grad N_a . sigma_0 . grad N_b.
  Eigen::Matrix3d initial_stress_stiffness(const SkinMaterial& skin) const {
    const Eigen::Matrix<double, 2, 3> gradient = gradients();
    return skin.thickness * area_ * gradient.transpose() * skin.prestress * gradient;
  }

 private:
  using Strain = Eigen::Matrix<double, 3, 6>;

  /// (e_uu, e_vv, 2 e_uv) from the displacements of the corners.
  static Strain strain_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    const double du[] = {b.y - c.y, c.y - a.y, a.y - b.y}, dv[] = {c.x - b.x, a.x - c.x, b.x - a.x};
    Strain strain = Strain::Zero();
    for (int i = 0; i < 3; ++i) {
      strain(0, 2 * i) = strain(2, 2 * i + 1) = du[i] / twice_area;
      strain(1, 2 * i + 1) = strain(2, 2 * i) = dv[i] / twice_area;
    }
    return strain;
  }

  double area_;
  Strain strain_;
};

}  // namespace cleft
