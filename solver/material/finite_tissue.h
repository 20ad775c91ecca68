// The material of a region of cells under finite strains: a law of hyperelasticity, as a value.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <span>

#include "solver/material/outer_products.h"

namespace cleft {

/// The gradients of a cell's six shape functions in the reference state, 1/mm, and the weight, mm^3, of a
/// quadrature point.
struct ReferencePoint {
  Eigen::Matrix<double, 3, 6> gradients;
  double volume;
};

/// The deformation gradient F at a point, and what the laws make of a shape function's gradient G: in the
/// spatial frame g = F^-T G, and h = F G.
struct Deformation {
  Eigen::Matrix3d gradient;
  double determinant;
  Eigen::Matrix<double, 3, 6> reference, spatial, carried;  ///< G, g and h of the six vertices

  Deformation(const ReferencePoint& point, const Eigen::Matrix<double, 3, 6>& displacements)
      : gradient(Eigen::Matrix3d::Identity() + displacements * point.gradients.transpose()),
        determinant(gradient.determinant()),
        reference(point.gradients),
        spatial(gradient.inverse().transpose() * point.gradients),
        carried(gradient * point.gradients) {}
};

/// A function of the change of volume J, and its derivatives, MPa.
struct VolumeEnergy {
  double energy = 0, first = 0, second = 0;
};

/// The stiffness between vertices a and b at a point, MPa/mm^2, by the products of their gradients:
///   spatial g_a g_b^T + mixed (g_a h_b^T + h_a g_b^T) + carried h_a h_b^T
///   + crossed_spatial g_b g_a^T + crossed_carried h_b h_a^T + even (G_a . G_b) I.
struct PointTangent {
  double spatial = 0, mixed = 0, carried = 0;                 // MPa
  double crossed_spatial = 0, crossed_carried = 0, even = 0;  // MPa
};

/// A law makes a value `at` of a deformation, with its energy, MPa, the force P G at a vertex, MPa/mm, and
/// the tangent; these have all of the energy but the part `volume`, a function of J alone, which may be taken
/// of an element's mean J. `has_volume` says whether there is such a part. What of the stiffness between two
/// vertices has another form is a function `rest` of these, MPa/mm^2.
template <class Law>
concept FiniteTissueLaw = requires(const Law& law, const Deformation& f) {
  { law.at(f).energy } -> std::convertible_to<double>;
  { law.at(f).force(0) } -> std::convertible_to<Eigen::Vector3d>;
  { law.at(f).tangent() } -> std::convertible_to<PointTangent>;
  { law.volume(1.) } -> std::convertible_to<VolumeEnergy>;
  { Law::has_volume } -> std::convertible_to<bool>;
};

/// Energy, N mm, forces, N, and on request the tangent, N/mm, of a cell; unknown 3 a + i is the displacement
/// of vertex a along axis i. They mean nothing if the cell has turned inside out.
struct CellResponse {
  double energy = 0;
  double least_determinant = 0;  ///< of F over the points: at most 0 if the cell has turned inside out
  Eigen::Matrix<double, 18, 1> force;
  Eigen::Matrix<double, 18, 18> stiffness;
};

class FiniteTissue {
 public:
  using Displacements = Eigen::Matrix<double, 3, 6>;  ///< of the vertices, mm

  template <FiniteTissueLaw Law>
  FiniteTissue(const Law& law)
      : has_volume_(Law::has_volume),
        respond_([law](std::span<const ReferencePoint> points, const Displacements& displacements,
                       const Eigen::Matrix3d& initial, bool mean, bool tangent, CellResponse& out) {
          respond(law, points, displacements, initial, mean, tangent, out);
        }) {}

  /// Whether mean dilatation is possible with it.
  bool has_volume() const { return has_volume_; }

  /// With `mean` the energy of the volume is that of the cell's mean J. `initial`: the stress that is there
  /// already (second Piola-Kirchhoff), MPa.
  void response(std::span<const ReferencePoint> points, const Displacements& displacements,
                const Eigen::Matrix3d& initial, bool mean, bool tangent, CellResponse& out) const {
    respond_(points, displacements, initial, mean, tangent, out);
  }

 private:
  template <class Law>
  static void respond(const Law& law, std::span<const ReferencePoint> points,
                      const Displacements& displacements, const Eigen::Matrix3d& initial, bool mean,
                      bool tangent, CellResponse& out);

  bool has_volume_;
  std::function<void(std::span<const ReferencePoint>, const Displacements&, const Eigen::Matrix3d&, bool,
                     bool, CellResponse&)>
      respond_;
};

template <class Law>
void FiniteTissue::respond(const Law& law, std::span<const ReferencePoint> points,
                           const Displacements& displacements, const Eigen::Matrix3d& initial, bool mean,
                           bool tangent, CellResponse& out) {
  out.energy = 0, out.least_determinant = HUGE_VAL;
  out.force.setZero();
  if (tangent) out.stiffness.setZero();
  Eigen::Matrix<double, 18, 1> mean_slope = Eigen::Matrix<double, 18, 1>::Zero();  // of the volume
  double reference_volume = 0, volume = 0;
  if (mean)
    for (const ReferencePoint& point : points) {
      const Eigen::Matrix3d gradient =
          Eigen::Matrix3d::Identity() + displacements * point.gradients.transpose();
      reference_volume += point.volume, volume += point.volume * gradient.determinant();
    }
  const VolumeEnergy of_mean = mean ? law.volume(volume / reference_volume) : VolumeEnergy{};
  if (mean) out.energy += reference_volume * of_mean.energy;
  const bool has_initial = !initial.isZero(0);
  OuterProducts straight, crossed;  // of the tangent: blocks (a, b) as they are, and those of (b, a)
  Eigen::Matrix<double, 6, 6> even = Eigen::Matrix<double, 6, 6>::Zero();
  for (const ReferencePoint& point : points) {
    const Deformation f(point, displacements);
    out.least_determinant = std::min(out.least_determinant, f.determinant);
    if (!(f.determinant > 0)) continue;
    const auto state = law.at(f);
    const double w = point.volume, j = f.determinant;
    const VolumeEnergy of_point = mean ? of_mean : law.volume(j);
    out.energy += w * state.energy + (mean ? 0 : w * of_point.energy);
    if (has_initial)
      out.energy +=
          w / 2 * (initial * (f.gradient.transpose() * f.gradient - Eigen::Matrix3d::Identity())).trace();
    const Eigen::Matrix<double, 3, 6> pulled = initial * f.reference;
    for (int a = 0; a < 6; ++a) {
      Eigen::Vector3d force = state.force(a) + of_point.first * j * f.spatial.col(a);
      if (has_initial) force += f.gradient * pulled.col(a);
      out.force.template segment<3>(3 * a) += w * force;
      if (mean) mean_slope.segment<3>(3 * a) += w * j * f.spatial.col(a);
    }
    if (!tangent) continue;
    PointTangent k = state.tangent();
    k.spatial += j * of_point.first + (mean ? 0 : j * j * of_point.second);
    k.crossed_spatial -= j * of_point.first;
    const Eigen::Map<const OuterProducts::Vector> g(f.spatial.data()), h(f.carried.data());
    straight.add(g, w * (k.spatial * g + k.mixed * h));
    straight.add(h, w * (k.mixed * g + k.carried * h));
    crossed.add(g, w * k.crossed_spatial * g);
    if (k.crossed_carried != 0) crossed.add(h, w * k.crossed_carried * h);
    even.noalias() += w * k.even * f.reference.transpose() * f.reference;
    if (has_initial) even.noalias() += w * f.reference.transpose() * pulled;
    if constexpr (requires { state.rest(0, 0); })
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) out.stiffness.template block<3, 3>(3 * a, 3 * b) += w * state.rest(a, b);
  }
  if (!tangent) return;
  out.stiffness += straight.sum();
  const OuterProducts::Matrix of_crossed = crossed.sum();
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      out.stiffness.template block<3, 3>(3 * a, 3 * b) +=
          of_crossed.template block<3, 3>(3 * a, 3 * b).transpose();
      out.stiffness.template block<3, 3>(3 * a, 3 * b).diagonal().array() += even(a, b);
    }
  if (mean)
    out.stiffness.noalias() += of_mean.second / reference_volume * mean_slope * mean_slope.transpose();
}

}  // namespace cleft
