// How a cut opens in stretched skin, in the plane: a sheet in plane stress that the tissue below holds back
// like springs,
//   div sigma(u) = k u,   sigma(u) n = -(the traction that the sheet had there) on the cut,
// whose stiffness depends on how fast u changes from place to place (Springs), by boundary elements whose
// jump is constant (displacement discontinuities: Crouch 1976). The fundamental solution is a sum of those
// of elastodynamics at imaginary frequencies (Eringen and Suhubi 1975). It knows no depth and no tissue
// beside the cut, but how its parts relieve each other, whichever way it winds; what it tells are ratios.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace cleft {

class CutMembrane {
 public:
  /// The stiffness of the springs for displacements in waves of the number w (radians for each mm): k for
  /// long ones, k (1 + more w^2 / (w^2 + 1 / l^2)) for short ones, with one `more` for waves that dilate the
  /// sheet, the other for waves that shear it: the tissue below a cut holds back what slides along it, and
  /// yields where its walls part. With the defaults openings of simulated paths that wind are right, and of
  /// cuts that cross or meet, in pieces whose openings are constant.
  struct Springs {
    double dilating = -1, shearing = 0.5;  ///< `more`, at least -1
    double length = 0.09;                  ///< l over the reach, at most a fifth
  };

  /// `reach`, mm: sqrt((lambda + 2 mu) / k), by which part displacements beside an endless straight cut fall
  /// by e where all waves have the same springs. Both are above 0, the ratio is below 1.
  CutMembrane(double reach, double poisson_ratio, const Springs& springs);
  CutMembrane(double reach, double poisson_ratio) : CutMembrane(reach, poisson_ratio, Springs{}) {}

  /// The same membrane with another reach.
  CutMembrane with_reach(double reach) const {
    CutMembrane result = *this;
    result.reach_ = reach;
    return result;
  }
  /// The same sheet, held otherwise.
  CutMembrane with(double reach, const Springs& springs) const {
    return {reach, lame_ / (lame_ + 2 * shear_), springs};
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
  Eigen::Matrix2d relief(const Eigen::Vector2d& begin, const Eigen::Vector2d& end) const {
    return linear_relief(begin, end).leftCols<2>();
  }

  /// The same, and that of an opening which is linear, from -1 at `begin` to 1 at `end`, along and across.
  Eigen::Matrix<double, 2, 4> linear_relief(const Eigen::Vector2d& begin, const Eigen::Vector2d& end) const;

 private:
  /// What is smooth of the derivatives of the fundamental solution at a distance, in the frame of the
  /// direction to it: of the part of waves that shear, along and across twice; of what the others take from
  /// it, over the square of the wave number, along four times, twice and never.
  using Derivatives = std::array<double, 5>;
  Derivatives smooth_part(double distance) const;

  double reach_, lame_, shear_;  // for a Young's modulus of 1
  std::shared_ptr<const std::vector<Derivatives>> table_;
};

}  // namespace cleft
