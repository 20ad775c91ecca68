// Regularised least squares for the spatial half of the fit. Paper, section 3.3.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "encoder/field/bspline.h"
#include "encoder/field/field.h"

namespace cleft {

/// Where data are given: a position, and the side for those on v = 0. Side::both asks both sides for the same
/// value.
struct Sample {
  Vec3 uvw;
  Side side;
};

/// Fits values at scattered samples by a tensor-product spline over (u, v, w): keeps one sparse Cholesky
/// factor of B^T B + lambda R for any number of right-hand sides. R penalises the second divided differences
/// of the control points along each axis (straight lines cost nothing), never across v = 0.
class SpatialFit {
 public:
  SpatialFit(const std::array<BSplineBasis, 3>& bases, const std::vector<Sample>& samples);

  int size() const { return count_[0] * count_[1] * count_[2]; }  ///< control points, w fastest

  /// B^T values: size() x 3.
  Eigen::MatrixX3d project(const std::vector<Vec3>& values) const;
  /// Control points for projected right-hand sides, columns alike.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& projected) const { return factor_.solve(projected); }

 private:
  static constexpr int order = 4;  // cubics: four functions an axis
  struct Row {
    std::array<BSplineBasis::Values, 3> basis;
    int sample;
  };

  void add_rows(const std::vector<Sample>& samples);
  Eigen::SparseMatrix<double> normal_matrix() const;
  Eigen::SparseMatrix<double> roughness(int axis) const;
  int index(int iu, int iv, int iw) const { return (iu * count_[1] + iv) * count_[2] + iw; }

  std::array<BSplineBasis, 3> bases_;
  std::array<int, 3> count_;
  std::vector<Row> rows_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace cleft
