// The material of a region of cells under finite strains: a law of hyperelasticity, as a value.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <span>

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

/// A law makes a value `at` of a deformation, with its energy, MPa, the force P G at a vertex and the
/// stiffness between two vertices, MPa/mm and MPa/mm^2; these have all of the energy but the part `volume`,
/// a function of J alone, which may be taken of an element's mean J. `has_volume` says whether there is such
/// a part.
template <class Law>
concept FiniteTissueLaw = requires(const Law& law, const Deformation& f) {
  { law.at(f).energy } -> std::convertible_to<double>;
  { law.at(f).force(0) } -> std::convertible_to<Eigen::Vector3d>;
  { law.at(f).stiffness(0, 0) } -> std::convertible_to<Eigen::Matrix3d>;
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
    const double pressure = w * j * of_point.first;
    const double stiffening = mean ? 0 : w * j * j * of_point.second;
    for (int a = 0; a < 6; ++a)
      for (int b = a; b < 6; ++b) {
        Eigen::Matrix3d k = w * state.stiffness(a, b);
        k.noalias() += (pressure + stiffening) * f.spatial.col(a) * f.spatial.col(b).transpose();
        k.noalias() -= pressure * f.spatial.col(b) * f.spatial.col(a).transpose();
        if (has_initial) k.diagonal().array() += w * f.reference.col(a).dot(pulled.col(b));
        out.stiffness.template block<3, 3>(3 * a, 3 * b) += k;
      }
  }
  if (!tangent) return;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < a; ++b)
      out.stiffness.template block<3, 3>(3 * a, 3 * b) =
          out.stiffness.template block<3, 3>(3 * b, 3 * a).transpose();
  if (mean)
    out.stiffness.noalias() += of_mean.second / reference_volume * mean_slope * mean_slope.transpose();
}

}  // namespace cleft
