// A constant-strain triangle of skin: a membrane in plane stress that carries a prestress and no bending.
// Paper, section 3.1.
#pragma once

#include <Eigen/Core>
#include <array>

#include "base/vec3.h"
#include "solver/material/skin_material.h"

namespace cleft {

/// Strains and stresses are in the triangle's own plane, with the directions e_u and e_v in it. Its only
/// stiffness out of that plane is that of the prestress.
class SkinTriangle {
 public:
  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  using Matrix93 = Eigen::Matrix<double, 9, 3>;

  /// Of the three corners, counter-clockwise from outside. e_u is `direction` within the triangle's plane;
  /// for a plane w = const and the default these are the directions of u and v.
  SkinTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& direction = {1, 0, 0}) {
    const Vec3 twice = cross(b - a, c - a);
    const Vec3 normal = (1 / norm(twice)) * twice;
    area_ = norm(twice) / 2;
    const Vec3 u = direction - dot(direction, normal) * normal;
    axes_[0] = (1 / norm(u)) * u;
    axes_[1] = cross(normal, axes_[0]);
    set_gradients(a, b, c);
  }

  double area() const { return area_; }  ///< mm^2

  /// e_u and e_v, unit vectors in space, one in each column.
  Eigen::Matrix<double, 3, 2> axes() const {
    Eigen::Matrix<double, 3, 2> axes;
    for (int i = 0; i < 2; ++i) axes.col(i) << axes_[i].x, axes_[i].y, axes_[i].z;
    return axes;
  }

  /// Of the shape functions of the corners, along e_u and e_v, 1/mm.
  const Eigen::Matrix<double, 2, 3>& gradients() const { return gradients_; }

  /// t A B^T D B over the displacements of the three corners.
  Matrix9 stiffness(const SkinMaterial& skin) const {
    const Strain strain = this->strain();
    return skin.thickness * area_ * strain.transpose() * skin.elasticity * strain;
  }

  /// Loads of the unit prestresses uu, vv, uv on the corners: -t A B^T, one in each column.
  Matrix93 unit_loads(const SkinMaterial& skin) const {
    return -skin.thickness * area_ * strain().transpose();
  }

  /// Geometric stiffness of the prestress between the corners, equal for all directions that it stiffens:
  /// t A grad N_a . sigma_0 . grad N_b.
  Eigen::Matrix3d initial_stress_stiffness(const SkinMaterial& skin) const {
    return skin.thickness * area_ * gradients_.transpose() * skin.prestress * gradients_;
  }

 private:
  using Strain = Eigen::Matrix<double, 3, 9>;

  void set_gradients(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto place = [&](const Vec3& p, int axis) { return dot(p, axes_[axis]); };
    const double du[] = {place(b, 1) - place(c, 1), place(c, 1) - place(a, 1), place(a, 1) - place(b, 1)};
    const double dv[] = {place(c, 0) - place(b, 0), place(a, 0) - place(c, 0), place(b, 0) - place(a, 0)};
    const double twice_area = dv[2] * du[1] - dv[1] * du[2];
    for (int i = 0; i < 3; ++i) gradients_.col(i) << du[i] / twice_area, dv[i] / twice_area;
  }

  /// (e_uu, e_vv, 2 e_uv) from the displacements of the corners.
  Strain strain() const {
    Strain strain;
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) {
        const double u = gradients_(0, i), v = gradients_(1, i);
        strain.col(3 * i + d) << u * axes_[0][d], v * axes_[1][d], v * axes_[0][d] + u * axes_[1][d];
      }
    return strain;
  }

  double area_;
  std::array<Vec3, 2> axes_;
  Eigen::Matrix<double, 2, 3> gradients_;
};

}  // namespace cleft
