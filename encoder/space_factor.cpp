#include "encoder/space_factor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "encoder/space_fit_parts.h"

namespace cleft {

Eigen::MatrixXd upper_cholesky_factor(const Eigen::MatrixXd& A) {
  return Eigen::LLT<Eigen::MatrixXd>(A).matrixU();
}

/// The Cholesky factor of a fit in space.
struct SpaceFit::Factor::Parts {
  std::shared_ptr<const SpaceFit::Parts> space;
  std::vector<Eigen::MatrixXd> diagonal;              // L of the diagonal blocks
  std::vector<std::array<Eigen::MatrixXd, 3>> lower;  // L of rows i + 1 .. i + 3 in column i
};

SpaceFit::Factor::~Factor() = default;
SpaceFit::Factor::Factor(Factor&&) noexcept = default;
SpaceFit::Factor::Factor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

/// The block between the unknowns of two rows: ties^T stencil ties.
Eigen::MatrixXd SpaceFit::Parts::tie(const Stencil& stencil, int row, int column) const {
  const auto &of_row = ties.row(row), &of_column = ties.row(column);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(ties.row_size(row), ties.row_size(column));
  for (int j = 0; j < V; ++j)
    for (int k = 0; k < W; ++k) {
      const ControlTies::Control& a = of_row[j * W + k];
      const double* values = &stencil[(static_cast<std::size_t>(j) * W + k) * reach * reach];
      for (int jj = std::max(0, j - order + 1); jj <= std::min(V - 1, j + order - 1); ++jj)
        for (int kk = std::max(0, k - order + 1); kk <= std::min(W - 1, k + order - 1); ++kk) {
          const double value = values[offset(jj - j, kk - k)];
          if (value == 0) continue;
          const ControlTies::Control& b = of_column[jj * W + kk];
          for (int x = 0; x < a.terms; ++x)
            for (int y = 0; y < b.terms; ++y)
              block(a.term[x].unknown, b.term[y].unknown) += value * a.term[x].weight * b.term[y].weight;
        }
    }
  return block;
}

SpaceFit::Factor SpaceFit::factorize(const Normal& normal) const {
  const Parts& p = *parts_;
  const int rows = p.bases[0].size();
  auto factor = std::make_unique<Factor::Parts>(Factor::Parts{parts_, {}, {}});
  std::vector<std::array<Eigen::MatrixXd, order>> blocks(rows);
  for (int i = 0; i < rows; ++i)
    for (int d = 0; d < order && i + d < rows; ++d)
      blocks[i][d] = d == 0 ? p.tie(normal.stencils_[i][0], i, i)
                            : Eigen::MatrixXd(p.tie(normal.stencils_[i][d], i, i + d).transpose());
  factor->diagonal.resize(rows), factor->lower.resize(rows);
  for (int i = 0; i < rows; ++i) {  // block Cholesky, column after column
    const Eigen::LLT<Eigen::MatrixXd> cholesky(blocks[i][0]);
    if (cholesky.info() != Eigen::Success)
      throw std::runtime_error("the fit's normal matrix is not positive definite");
    factor->diagonal[i] = cholesky.matrixL();
    const auto upper = factor->diagonal[i].transpose().triangularView<Eigen::Upper>();
    for (int d = 1; d < order && i + d < rows; ++d)
      factor->lower[i][d - 1] = upper.solve<Eigen::OnTheRight>(blocks[i][d]);
    for (int d = 1; d < order && i + d < rows; ++d) {
      blocks[i + d][0].selfadjointView<Eigen::Lower>().rankUpdate(factor->lower[i][d - 1], -1);
      for (int e = d + 1; e < order && i + e < rows; ++e)
        blocks[i + d][e - d].noalias() -= factor->lower[i][e - 1] * factor->lower[i][d - 1].transpose();
    }
  }
  return Factor(std::move(factor));
}

/// Columns are few, and the library would copy every block for products with matrices: it multiplies one
/// column after another, while a block is in the cache.
Eigen::MatrixXd SpaceFit::Factor::solve(Eigen::MatrixXd x) const {
  const ControlTies& ties = parts_->space->ties;
  const int rows = ties.rows();
  const auto part = [&](int i, Eigen::Index column) {
    return x.col(column).segment(ties.first(i), ties.row_size(i));
  };
  for (int i = 0; i < rows; ++i) {
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      parts_->diagonal[i].triangularView<Eigen::Lower>().solveInPlace(part(i, c));
    for (int d = 1; d < order && i + d < rows; ++d)
      for (Eigen::Index c = 0; c < x.cols(); ++c)
        part(i + d, c).noalias() -= parts_->lower[i][d - 1] * part(i, c);
  }
  for (int i = rows - 1; i >= 0; --i) {
    for (int d = 1; d < order && i + d < rows; ++d)
      for (Eigen::Index c = 0; c < x.cols(); ++c)
        part(i, c).noalias() -= parts_->lower[i][d - 1].transpose() * part(i + d, c);
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      parts_->diagonal[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part(i, c));
  }
  return x;
}

double SpaceFit::Factor::condition() const {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Eigen::MatrixXd& block : parts_->diagonal) {
    least = std::min(least, block.diagonal().minCoeff());
    greatest = std::max(greatest, block.diagonal().maxCoeff());
  }
  return (greatest / least) * (greatest / least);
}

double SpaceFit::Factor::bytes() const {
  double entries = 0;
  for (const Eigen::MatrixXd& block : parts_->diagonal) entries += static_cast<double>(block.size());
  for (const auto& of_column : parts_->lower)
    for (const Eigen::MatrixXd& block : of_column) entries += static_cast<double>(block.size());
  return entries * sizeof(double);
}

}  // namespace cleft
