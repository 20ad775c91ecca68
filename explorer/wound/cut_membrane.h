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
#include <memory>
#include <vector>

namespace cleft {

class CutMembrane {
 public:
  /// `reach`, mm: by which part displacements beside an endless straight cut fall by e,
  /// sqrt((lambda + 2 mu) / k). Both are above 0, the ratio is below 1.
  CutMembrane(double reach, double poisson_ratio);

  /// The same membrane with another reach.
  CutMembrane with_reach(double reach) const {
    CutMembrane result = *this;
    result.reach_ = reach;
    return result;
  }

  /// How a cut opens between its corners, mm, in the middles of its straight pieces. Each piece has a frame:
  /// along, to the next corner, and across, a quarter turn from there, from the first axis toward the second.
  /// The opening is the displacement on the side to which `across` points less that on the other, for forces
  /// in E times the sheet's thickness. Rows are along the first piece, across it, along the second, ...; a
  /// column for each load. `tractions` are those on the pieces before they are cut: the shear and the tension
  /// across.
  Eigen::MatrixXd openings(const std::vector<Eigen::Vector2d>& corners,
                           const Eigen::MatrixXd& tractions) const;

  double reach() const { return reach_; }

  /// What a unit opening between two corners, along and across, takes from the traction on a piece; both in
  /// the piece's frame, in whose middle the corners are seen.
  Eigen::Matrix2d relief(const Eigen::Vector2d& begin, const Eigen::Vector2d& end) const;

 private:
  /// What is smooth of the second derivatives of the fundamental solution at a distance, in the frame of the
  /// direction to it: of K0(k2 r), along and across twice; of K0(k2 r) - K0(k1 r), along four times, twice
  /// and never.
  using Derivatives = std::array<double, 5>;
  Derivatives smooth_part(double distance) const;

  double reach_, lame_, shear_;  // for a Young's modulus of 1
  std::shared_ptr<const std::vector<Derivatives>> table_;
};

}  // namespace cleft
