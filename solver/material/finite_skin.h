// The material of a region of the skin under finite strains: a membrane's law of hyperelasticity, as a value.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <functional>

namespace cleft {

/// Energy, second Piola-Kirchhoff stress (uu, vv, uv) and its tangent by the strain, MPa.
struct SkinResponse {
  double energy = 0;
  Eigen::Vector3d stress;
  Eigen::Matrix3d tangent;
};

/// A law gives the response to Green's strain (E_uu, E_vv, 2 E_uv) from the reference state, in which the
/// skin is under its prestress: at 0 the stress is the prestress, and the tangent that of plane stress with
/// the moduli of the linear model. Not finite where the strain is none of a membrane.
template <class Law>
concept FiniteSkinLaw = requires(const Law& law, const Eigen::Vector3d& strain) {
  { law.at(strain) } -> std::convertible_to<SkinResponse>;
};

class FiniteSkin {
 public:
  template <FiniteSkinLaw Law>
  FiniteSkin(double skin_thickness, const Law& law)
      : thickness(skin_thickness), at_([law](const Eigen::Vector3d& strain) { return law.at(strain); }) {}

  SkinResponse at(const Eigen::Vector3d& strain) const { return at_(strain); }

  double thickness;  ///< mm

 private:
  std::function<SkinResponse(const Eigen::Vector3d&)> at_;
};

}  // namespace cleft
