#include "encoder/interpolate/case_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr Eigen::Index piece = 4096;  // control points' numbers that are in double precision at a time
constexpr int places_along_lips = 16;

/// The inner products of columns, in double precision.
Eigen::MatrixXd gram_of(const std::vector<std::span<const float>>& columns, const Eigen::VectorXd& scales) {
  const auto count = static_cast<Eigen::Index>(columns.size()),
             size = static_cast<Eigen::Index>(columns.front().size());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count), block(piece, count);
  for (Eigen::Index first = 0; first < size; first += piece) {
    const Eigen::Index rows = std::min(piece, size - first);
    for (Eigen::Index i = 0; i < count; ++i)
      block.col(i).head(rows) =
          Eigen::Map<const Eigen::VectorXf>(columns[static_cast<std::size_t>(i)].data() + first, rows)
              .cast<double>() /
          scales[i];
    gram.selfadjointView<Eigen::Lower>().rankUpdate(block.topRows(rows).transpose());
  }
  return gram.selfadjointView<Eigen::Lower>();
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

CaseModes::CaseModes(const StudyInterpolator& study, double error) : study_(study) {
  const CommonCases& cases = study.cases();
  std::vector<std::span<const float>> columns;
  columns.reserve(static_cast<std::size_t>(cases.size()) + cases.derivatives().size());
  for (int i = 0; i < cases.size(); ++i) columns.push_back(cases.control_points(i));
  for (std::size_t d = 0; d < cases.derivatives().size(); ++d) columns.push_back(cases.derivative_points(d));
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::VectorXd scales(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::span<const float> column = columns[static_cast<std::size_t>(i)];
    const double norm =
        Eigen::Map<const Eigen::VectorXf>(column.data(), static_cast<Eigen::Index>(column.size()))
            .cast<double>()
            .norm();
    scales[i] = norm > 0 ? norm : 1;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram_of(columns, scales));
  const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();
  const Eigen::VectorXd values = solver.eigenvalues().reverse().cwiseMax(0.);

  // What K modes leave of the i-th case: 1 - the sum of its squared coordinates, lambda_k V_ik^2.
  Eigen::VectorXd left = Eigen::VectorXd::Ones(count);
  Eigen::Index kept = 0;
  while (kept < count && left.maxCoeff() > error * error) {
    left -= values[kept] * vectors.col(kept).cwiseAbs2();
    ++kept;
  }
  shares_ = vectors.leftCols(kept).transpose() * scales.asDiagonal();
  for (Eigen::Index k = 0; k < kept; ++k) {
    std::vector<Summand> summands;
    summands.reserve(columns.size());
    for (Eigen::Index i = 0; i < count; ++i)
      summands.push_back({vectors(i, k) / scales[i], columns[static_cast<std::size_t>(i)]});
    std::vector<float>& mode = modes_.emplace_back();
    for (const Vec3& point : sum_of(summands))
      for (int c = 0; c < 3; ++c) mode.push_back(static_cast<float>(point[c]));
  }
}

Field CaseModes::at(const CaseParameters& values) const {
  const StudyInterpolator::Recipe recipe = study_.recipe(values);
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
