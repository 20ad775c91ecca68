// Skin that stiffens exponentially (Fung), with a family of fibres whose directions are dispersed (Gasser,
// Ogden and Holzapfel 2006). The reference state is on the curve: released tension softens the skin down to
// its toe.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "solver/material/finite_skin.h"

namespace cleft {

/// W = 1/beta exp(beta/2 (e . a e - e_0 . a e_0)) of the strain e = E + e_0 from the state without stress. At
/// E = 0 the stress is s and the tangent D, which determines a = D - beta s s^T and e_0 = a^-1 s. In the
/// direction of s the tangent without stress is D's times (1 - x) exp(-x / (2 (1 - x))), x = beta s . D^-1 s;
/// x is chosen such that this factor is the reciprocal of the stiffening.
template <int n>
struct ExponentialLaw {
  using Vector = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n>;

  Vector stress, start;
  Matrix moduli;
  double beta = 0, at_start = 0;  // beta = 0: the law is linear

  ExponentialLaw(const Vector& s, const Matrix& tangent, double stiffening) : stress(s), moduli(tangent) {
    const double work = s.dot(tangent.inverse() * s);
    if (!(work > 0) || !(stiffening > 1)) return;
    double less = 0, more = 1;
    for (int i = 0; i < 100; ++i) {
      const double x = (less + more) / 2;
      (std::log(1 - x) - x / (2 * (1 - x)) > -std::log(stiffening) ? less : more) = x;
    }
    beta = less / work;
    moduli -= beta * s * s.transpose();
    start = moduli.inverse() * s;
    at_start = beta / 2 * start.dot(s);
  }

  struct Response {
    double energy;
    Vector stress;
    Matrix tangent;
  };

  Response at(const Vector& strain) const {
    if (beta == 0) {
      const Vector change = moduli * strain;
      return {strain.dot(stress + change / 2), stress + change, moduli};
    }
    const Vector e = strain + start, linear = moduli * e;
    const double factor = std::exp(beta / 2 * e.dot(linear) - at_start);
    return {(factor - 1) / beta, factor * linear, factor * (moduli + beta * linear * linear.transpose())};
  }
};

/// The sum of a matrix and of fibres. With the structure tensor h = kappa I + (1 - 2 kappa) m m^T (kappa 0:
/// all along m; 1/2: all directions alike) the fibres' strain is h : E; they carry no compression. Of the
/// tangent D they have D_f h h^T, where D_f is their share of the most that leaves D semidefinite,
/// 1 / (h . D^-1 h); of the prestress they have s_f h, likewise their share of its part along h. The sum at
/// the reference state is sigma_0 and D, whatever the share.
class FungSkin {
 public:
  struct Fibres {
    double share = 0;       ///< 0: none; less than 1
    double direction = 0;   ///< of m, radians from u toward v
    double dispersion = 0;  ///< kappa
  };

  FungSkin(const Eigen::Vector3d& prestress, const Eigen::Matrix3d& elasticity, double stiffening,
           const Fibres& fibres)
      : FungSkin(prestress, elasticity, stiffening, structure(fibres),
                 fibres.share / structure(fibres).dot(elasticity.inverse() * structure(fibres))) {}

  SkinResponse at(const Eigen::Vector3d& strain) const {
    const auto [energy, stress, tangent] = matrix_.at(strain);
    SkinResponse r{energy, stress, tangent};
    if (fibre_stiffness_ == 0) return r;
    const double stretch = structure_.dot(strain);
    if (stretch < slack_) {
      r.energy += energy_when_slack_;
      return r;
    }
    const auto fibre = fibres_.at(Eigen::Matrix<double, 1, 1>(stretch));
    r.energy += fibre.energy;
    r.stress += fibre.stress[0] * structure_;
    r.tangent += fibre.tangent(0, 0) * structure_ * structure_.transpose();
    return r;
  }

 private:
  using One = Eigen::Matrix<double, 1, 1>;

  FungSkin(const Eigen::Vector3d& prestress, const Eigen::Matrix3d& elasticity, double stiffening,
           const Eigen::Vector3d& h, double fibre_stiffness)
      : structure_(h),
        fibre_stiffness_(fibre_stiffness),
        fibre_stress_(fibre_stiffness * std::max(0., h.dot(elasticity.inverse() * prestress))),
        matrix_(prestress - fibre_stress_ * h, elasticity - fibre_stiffness * h * h.transpose(), stiffening),
        fibres_(One(fibre_stress_), One(fibre_stiffness), stiffening) {
    if (fibre_stress_ == 0) return;
    slack_ = fibres_.beta > 0 ? -fibres_.start[0] : -fibre_stress_ / fibre_stiffness;
    energy_when_slack_ = fibres_.at(One(slack_)).energy;
  }

  /// (uu, vv, uv): its product with (E_uu, E_vv, 2 E_uv) is h : E.
  static Eigen::Vector3d structure(const Fibres& f) {
    const double c = std::cos(f.direction), s = std::sin(f.direction), aligned = 1 - 2 * f.dispersion;
    return {f.dispersion + aligned * c * c, f.dispersion + aligned * s * s, aligned * c * s};
  }

  Eigen::Vector3d structure_;
  double fibre_stiffness_, fibre_stress_;
  ExponentialLaw<3> matrix_;
  ExponentialLaw<1> fibres_;
  double slack_ = -HUGE_VAL, energy_when_slack_ = 0;  // fibres are slack below this strain
};

}  // namespace cleft
