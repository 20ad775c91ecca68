#include "encoder/interpolate/case_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr Eigen::Index piece = 4096;  // control points' numbers that are in double precision at a time
constexpr int places_along_lips = 16;

/// Control points of all cases and derivatives, each over its norm.
class CaseColumns {
 public:
  explicit CaseColumns(const CommonCases& cases) {
    for (int i = 0; i < cases.size(); ++i) columns_.push_back(cases.control_points(i));
    for (std::size_t d = 0; d < cases.derivatives().size(); ++d)
      columns_.push_back(cases.derivative_points(d));
    norms_.resize(count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      const auto& column = columns_[static_cast<std::size_t>(i)];
      const double norm = Eigen::Map<const Eigen::VectorXf>(column.data(), size()).cast<double>().norm();
      norms_[i] = norm > 0 ? norm : 1;
    }
  }

  Eigen::Index count() const { return static_cast<Eigen::Index>(columns_.size()); }
  Eigen::Index size() const { return static_cast<Eigen::Index>(columns_.front().size()); }
  const Eigen::VectorXd& norms() const { return norms_; }

  /// Calls use(first, rows, block) for all of the numbers, a piece at a time: `rows` of them from the first
  /// on. A block has as many rows everywhere, 0 beyond the last number.
  template <class Number, class Use>
  void for_pieces(const Use& use) const {
    Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> block(piece, count());
    for (Eigen::Index first = 0; first < size(); first += piece) {
      const Eigen::Index rows = std::min(piece, size() - first);
      block.bottomRows(piece - rows).setZero();
      for (Eigen::Index i = 0; i < count(); ++i)
        block.col(i).head(rows) =
            Eigen::Map<const Eigen::VectorXf>(columns_[static_cast<std::size_t>(i)].data() + first, rows)
                .cast<Number>() /
            static_cast<Number>(norms_[i]);
      use(first, rows, block);
    }
  }

 private:
  std::vector<std::span<const float>> columns_;
  Eigen::VectorXd norms_;
};

/// The inner products of columns, in double precision.
Eigen::MatrixXd gram_of(const CaseColumns& columns) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns.count(), columns.count());
  columns.for_pieces<double>([&](Eigen::Index, Eigen::Index, const Eigen::MatrixXd& block) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
  });
  return gram.selfadjointView<Eigen::Lower>();
}

/// Sums of columns. Blocks are all of one size, so that numbers which are the same in all columns stay the
/// same, bit for bit: a matrix product adds up its last rows in another order if they do not fill a register.
std::vector<std::vector<float>> sums_of(const CaseColumns& columns, const Eigen::MatrixXd& weights) {
  std::vector<std::vector<float>> sums(static_cast<std::size_t>(weights.cols()));
  for (auto& sum : sums) sum.resize(static_cast<std::size_t>(columns.size()));
  const Eigen::MatrixXf rounded = weights.cast<float>();
  Eigen::MatrixXf product(piece, weights.cols());
  columns.for_pieces<float>([&](Eigen::Index first, Eigen::Index rows, const Eigen::MatrixXf& block) {
    product.noalias() = block * rounded;
    for (Eigen::Index k = 0; k < weights.cols(); ++k)
      Eigen::Map<Eigen::VectorXf>(sums[static_cast<std::size_t>(k)].data() + first, rows) =
          product.col(k).head(rows);
  });
  return sums;
}

/// Of the lips when all is cut, mm.
double largest_of_lips(const Field& field) {
  double largest = 0;
  for (int i = 1; i < places_along_lips; ++i)
    for (const Side side : {Side::left, Side::right}) {
      const Vec3 place{field.cut().start + field.cut().length * i / places_along_lips, 0, 0};
      largest = std::max(largest, norm(field.displacement(place, side, field.duration())));
    }
  return largest;
}

}  // namespace

CaseModes::CaseModes(const StudyInterpolator& study, double error, double enough, int many) : study_(study) {
  const CaseColumns columns(study.cases());
  const Eigen::MatrixXd gram = gram_of(columns);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();
  const Eigen::VectorXd values = solver.eigenvalues().reverse().cwiseMax(0.);

  // What K modes leave of the i-th case: its square less the sum of those of its coordinates, lambda_k
  // V_ik^2. The square is 1, or 0 of a load that moves nothing.
  Eigen::VectorXd left = gram.diagonal();
  Eigen::Index kept = 0;
  const auto allowed = [&] { return std::pow(kept < many ? error : enough, 2); };
  while (kept < columns.count() && left.maxCoeff() > allowed()) {
    left -= values[kept] * vectors.col(kept).cwiseAbs2();
    ++kept;
  }
  shares_ = vectors.leftCols(kept).transpose() * columns.norms().asDiagonal();
  modes_ = sums_of(columns, vectors.leftCols(kept));
}

Field CaseModes::at(const CaseParameters& values) const {
  const StudyInterpolator::Recipe recipe = study_.recipe(values, false);
  const auto& [cases, derivatives, error] = recipe.prediction;
  Eigen::VectorXd weights(shares_.cols());
  weights << cases, derivatives;
  if (derivatives.size() == 0 && weights.size() > cases.size())
    weights.tail(weights.size() - cases.size()).setZero();
  const Eigen::VectorXd sizes = shares_ * weights;
  std::vector<Summand> summands;
  summands.reserve(modes_.size());
  for (std::size_t k = 0; k < modes_.size(); ++k)
    summands.push_back({sizes[static_cast<Eigen::Index>(k)], modes_[k]});
  Field field = study_.cases().field_of(sum_of(summands), recipe.geometry);
  study_.tell(field, recipe, largest_of_lips(field));
  return field;
}

}  // namespace cleft
