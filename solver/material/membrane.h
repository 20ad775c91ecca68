// The skin: a constant-strain triangle in plane stress with a prestress and without bending stiffness. Paper,
// section 3.1.
#pragma once

#include <Eigen/Core>

#include "base/vec3.h"
#include "params/parameters.h"

namespace cleft {

/// The skin is in a plane w = const with the directions u and v; its only stiffness along w is that of the
/// prestress.
class Membrane {
 public:
  explicit Membrane(const Parameters::Skin& skin) : thickness_(skin.thickness) {
    const double nu = skin.poisson_ratio;
    elasticity_ << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
    elasticity_ *= skin.young_modulus / (1 - nu * nu);
    prestress_ << skin.prestress_u, skin.prestress_uv, skin.prestress_uv, skin.prestress_v;
  }

  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Matrix63 = Eigen::Matrix<double, 6, 3>;

  /// t A B^T D B over (u, v) of the three corners.
  Matrix6 stiffness(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Strain strain = strain_of(a, b, c);
    return thickness_ * area(a, b, c) * strain.transpose() * elasticity_ * strain;
  }

  /// Loads of the unit prestresses uu, vv, uv on (u, v) of the corners: -t A B^T, one in each column.
  Matrix63 unit_loads(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return -thickness_ * area(a, b, c) * strain_of(a, b, c).transpose();
  }

  /// Geometric stiffness of the prestress between the corners, equal for the three directions: t A grad N_a .
  /// sigma_0 . grad N_b.
  Eigen::Matrix3d initial_stress_stiffness(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Strain strain = strain_of(a, b, c);
    Eigen::Matrix<double, 2, 3> gradient;
    for (int i = 0; i < 3; ++i) gradient.col(i) << strain(0, 2 * i), strain(1, 2 * i + 1);
    return thickness_ * area(a, b, c) * gradient.transpose() * prestress_ * gradient;
  }

 private:
  using Strain = Eigen::Matrix<double, 3, 6>;

  static double area(const Vec3& a, const Vec3& b, const Vec3& c) { return norm(cross(b - a, c - a)) / 2; }

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

  double thickness_;
  Eigen::Matrix3d elasticity_;
  Eigen::Matrix2d prestress_;
};

}  // namespace cleft
