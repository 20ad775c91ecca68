#include "encoder/spatial_fit.h"

#include <stdexcept>

#include "base/error.h"

namespace cleft {

namespace {

constexpr double roughness_strength = 1e-7;  // relative to the mean diagonal of B^T B
constexpr double diagonal_strength = 1e-10;  // holds what neither data nor roughness reach

using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

SpatialFit::SpatialFit(const std::array<BSplineBasis, 3>& bases, const std::vector<Sample>& samples)
    : bases_(bases), count_{bases[0].size(), bases[1].size(), bases[2].size()} {
  for (const BSplineBasis& basis : bases) CLEFT_CHECK(basis.degree() + 1, ==, int(order));
  add_rows(samples);
  Eigen::SparseMatrix<double> matrix = normal_matrix();
  const double scale = matrix.diagonal().mean();
  for (int axis = 0; axis < 3; ++axis) matrix += roughness_strength * scale * roughness(axis);
  Eigen::SparseMatrix<double> identity(size(), size());
  identity.setIdentity();
  matrix += diagonal_strength * scale * identity;
  factor_.compute(matrix);
  if (factor_.info() != Eigen::Success)
    throw std::runtime_error("the fit's normal matrix is not positive definite");
}

void SpatialFit::add_rows(const std::vector<Sample>& samples) {
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Vec3& p = samples[s].uvw;
    const bool uncut_plane = p.y == 0 && samples[s].side == Side::both;
    for (const Limit limit : {Limit::from_left, Limit::from_right}) {
      const bool left = limit == Limit::from_left;
      if (!uncut_plane && left != (p.y < 0 || (p.y == 0 && samples[s].side == Side::left))) continue;
      rows_.push_back({{bases_[0].evaluate(p.x), bases_[1].evaluate(p.y, limit), bases_[2].evaluate(p.z)},
                       static_cast<int>(s)});
    }
  }
}

Eigen::MatrixX3d SpatialFit::project(const std::vector<Vec3>& values) const {
  Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(size(), 3);
  for (const Row& row : rows_) {
    const auto& [u, v, w] = row.basis;
    const Vec3& value = values[static_cast<std::size_t>(row.sample)];
    const Eigen::RowVector3d d(value.x, value.y, value.z);
    for (int i = 0; i < order; ++i)
      for (int j = 0; j < order; ++j)
        for (int k = 0; k < order; ++k)
          sum.row(index(u.first + i, v.first + j, w.first + k)) += u.value[i] * v.value[j] * w.value[k] * d;
  }
  return sum;
}

Eigen::SparseMatrix<double> SpatialFit::normal_matrix() const {
  // Two control points meet only where their indices differ by at most 3 on every axis: a stencil of 7^3 a
  // row.
  constexpr int reach = 2 * order - 1;
  std::vector<double> stencil(static_cast<std::size_t>(size()) * reach * reach * reach, 0);
  for (const Row& row : rows_) {
    const auto& [u, v, w] = row.basis;
    std::array<double, order * order * order> value;
    for (int i = 0; i < order; ++i)
      for (int j = 0; j < order; ++j)
        for (int k = 0; k < order; ++k)
          value[(i * order + j) * order + k] = u.value[i] * v.value[j] * w.value[k];
    for (int a = 0; a < order * order * order; ++a) {
      const int ai = a / 16, aj = a / 4 % 4, ak = a % 4;
      double* of_row = &stencil[static_cast<std::size_t>(index(u.first + ai, v.first + aj, w.first + ak)) *
                                reach * reach * reach];
      for (int bi = 0; bi < order; ++bi)
        for (int bj = 0; bj < order; ++bj) {
          double* line = of_row + ((bi - ai + 3) * reach + (bj - aj + 3)) * reach + 3 - ak;
          const double* other = &value[(bi * order + bj) * order];
          for (int bk = 0; bk < order; ++bk) line[bk] += value[a] * other[bk];
        }
    }
  }
  Triplets triplets;
  for (int iu = 0; iu < count_[0]; ++iu)
    for (int iv = 0; iv < count_[1]; ++iv)
      for (int iw = 0; iw < count_[2]; ++iw)
        for (int s = 0; s < reach * reach * reach; ++s) {
          const double value =
              stencil[static_cast<std::size_t>(index(iu, iv, iw)) * reach * reach * reach + s];
          const int ju = iu + s / (reach * reach) - 3, jv = iv + s / reach % reach - 3,
                    jw = iw + s % reach - 3;
          if (value != 0) triplets.emplace_back(index(iu, iv, iw), index(ju, jv, jw), value);
        }
  Eigen::SparseMatrix<double> matrix(size(), size());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

Eigen::SparseMatrix<double> SpatialFit::roughness(int axis) const {
  const BSplineBasis& basis = bases_[axis];
  const int n = basis.size(), degree = basis.degree();
  std::vector<double> greville(n, 0.0);  // where each control point sits
  for (int i = 0; i < n; ++i)
    for (int k = 1; k <= degree; ++k) greville[i] += basis.knots()[i + k] / degree;
  const double spacing = (basis.back() - basis.front()) / (n - 1);

  Triplets triplets;
  int rows = 0;
  for (int i = 1; i + 1 < n; ++i) {
    const double before = greville[i] - greville[i - 1], after = greville[i + 1] - greville[i];
    if (before <= 0 || after <= 0) continue;  // two control points in one place: the break at v = 0
    for (int a = 0; a < count_[(axis + 1) % 3]; ++a)
      for (int b = 0; b < count_[(axis + 2) % 3]; ++b) {
        const auto at = [&](int along) {
          std::array<int, 3> i3;
          i3[axis] = along, i3[(axis + 1) % 3] = a, i3[(axis + 2) % 3] = b;
          return index(i3[0], i3[1], i3[2]);
        };
        triplets.emplace_back(rows, at(i - 1), spacing / before);
        triplets.emplace_back(rows, at(i), -spacing / before - spacing / after);
        triplets.emplace_back(rows, at(i + 1), spacing / after);
        ++rows;
      }
  }
  Eigen::SparseMatrix<double> difference(rows, size());
  difference.setFromTriplets(triplets.begin(), triplets.end());
  return difference.transpose() * difference;
}

}  // namespace cleft
