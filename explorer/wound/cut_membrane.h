// How a cut opens in stretched skin, in the plane: a sheet in plane stress that the tissue below holds back
// like springs,
//   div sigma(u) = k u,   sigma(u) n = -(the traction that the sheet had there) on the cut,
// by boundary elements whose jump is constant (displacement discontinuities: Crouch 1976), with the
// fundamental solution of elastodynamics at an imaginary frequency (Eringen and Suhubi 1975). It knows no
// depth and no tissue beside the cut, but how its parts relieve each other, whichever way it winds; what it
// tells are ratios.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace cleft {

using PlanePoint = std::array<double, 2>;  ///< mm

class CutMembrane {
 public:
  /// `reach`, mm: by which part displacements beside an endless straight cut fall by e,
  /// sqrt((lambda + 2 mu) / k). Both are above 0, the ratio is below 1.
  CutMembrane(double reach, double poisson_ratio);

  /// How the pieces of a cut between so many corners open. Each has a frame: along, to the next corner, and
  /// across, a quarter turn from there, from the first axis toward the second. Rows are along the first
  /// piece, across it, along the second, ...; a column for each load. `tractions` are those on the pieces
  /// before they are cut: the shear and the tension across. Openings are the displacement on the side to
  /// which `across` points less that on the other, mm, for forces in E times the sheet's thickness.
  Eigen::MatrixXd openings(const std::vector<PlanePoint>& corners, const Eigen::MatrixXd& tractions) const;

 private:
  /// What is smooth of the second derivatives of the fundamental solution at a distance, in the frame of the
  /// direction to it: of K0(k2 r), along and across twice; of K0(k2 r) - K0(k1 r), along four times, twice
  /// and never.
  using Derivatives = std::array<double, 5>;
  Derivatives smooth_part(double distance) const;

  double reach_, lame_, shear_;  // for a Young's modulus of 1
  std::vector<Derivatives> table_;
};

}  // namespace cleft
