#include "encoder/interpolate/common_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "encoder/field/unknowns.h"
#include "encoder/interpolate/field_samples.h"

namespace cleft {

namespace {

// What the steps of all modes together may do to a case, over the error allowed.
constexpr double share_of_steps = 0.25;
constexpr double weights_per_unit = 1e5;    // modes are as large as the cases
constexpr std::size_t bytes_of_weight = 3;  // deflated

/// The cases on common knots, each over its largest displacement: their unknowns, and samples of them.
class ScaledCases {
 public:
  explicit ScaledCases(const std::vector<StudyMember>& members)
      : common_(members),
        places_(places_in_common(common_)),
        grid_(places_of(ties(), common_.bases())),
        samples_(sample_cases(common_, places_)) {
    for (const StudyMember& member : members) members_[member.name] = &member;
    for (int i = 0; i < common_.size(); ++i) {
      const double largest = this->largest(i);
      const Unknowns unknowns = unknowns_of(common_.field_of(common_.points(i), places_.body), grid_, 1);
      if (i == 0)
        slices_ = unknowns.slices,
        unknowns_.resize(static_cast<Eigen::Index>(unknowns.values.size()), size());
      apart_.push_back(unknowns.slices != slices_ || !member(i).field.quantities.empty() ||
                       !member(i).field.by_parameter.empty() || !(largest > 0));
      for (Eigen::Index n = 0; n < unknowns_.rows(); ++n)
        unknowns_(n, i) =
            apart_.back() ? 0 : static_cast<float>(unknowns.values[static_cast<std::size_t>(n)] / largest);
      samples_.col(i) *= apart_.back() ? 0 : 1 / largest;
    }
  }

  int size() const { return common_.size(); }
  const StudyMember& member(int i) const {
    return *members_.at(common_.cases()[static_cast<std::size_t>(i)].name);
  }
  double largest(int i) const { return member(i).field.report.largest_displacement; }
  bool apart(int i) const {
    return apart_[static_cast<std::size_t>(i)];
  }  ///< never a sum of modes; its columns are 0
  const Eigen::MatrixXf& unknowns() const { return unknowns_; }
  const Eigen::MatrixXd& samples() const { return samples_; }
  const CoefficientGrid& grid() const { return grid_; }
  int slices() const { return slices_; }

  Eigen::VectorXd samples_of(const std::vector<double>& unknowns) const {
    return sample(common_, control_points(ties(), common_.bases(), unknowns), places_);
  }
  /// The field on common knots, with all else that its file holds.
  Field field(int i) const {
    const Field& own = member(i).field;
    Field field = common_.field_of(common_.points(i), own.parametrization().geometry());
    field.parameters = own.parameters, field.case_hash = own.case_hash, field.report = own.report;
    field.interpolation = own.interpolation;
    return field;
  }

 private:
  ControlTies ties() const { return ties_of(common_.parametrization(), common_.bases()); }

  CommonCases common_;
  CommonPlaces places_;
  CoefficientGrid grid_;
  Eigen::MatrixXd samples_;
  std::map<std::string, const StudyMember*> members_;
  int slices_ = 0;
  Eigen::MatrixXf unknowns_;
  std::vector<bool> apart_;
};

/// Of the samples' singular value decomposition: weights of the cases in each mode, leading first, so that
/// the mode is as large as what it holds of a case in the mean.
Eigen::MatrixXd mode_weights(const ScaledCases& cases) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(cases.samples().transpose() * cases.samples());
  return eigen.eigenvectors().rowwise().reverse() / std::sqrt(static_cast<double>(cases.size()));
}

/// Modes as they are stored.
struct Coded {
  CodedModes modes;
  Eigen::MatrixXd samples;
};

Coded code(const ScaledCases& cases, const Eigen::MatrixXd& weights, double error) {
  const double quantum = share_of_steps * error * std::sqrt(12. / static_cast<double>(weights.cols()));
  Coded coded;
  coded.samples.resize(cases.samples().rows(), weights.cols());
  for (Eigen::Index k = 0; k < weights.cols(); ++k) {
    const Eigen::VectorXf mode = cases.unknowns() * weights.col(k).cast<float>();
    std::vector<double> values;
    for (const float value : mode) values.push_back(value / quantum);
    const auto integers = round_coefficients(cases.grid(), cases.slices(), values, 0.5);
    coded.modes.quanta.push_back(quantum);
    coded.modes.coefficients.push_back(encode_coefficients(cases.grid(), cases.slices(), integers));
    coded.samples.col(k) = cases.samples_of(multiples(integers, quantum));
  }
  return coded;
}

/// The cases' samples without what the leading modes hold of them, one more mode at a time.
class Remainder {
 public:
  explicit Remainder(const ScaledCases& cases) : samples_(cases.samples()) {}
  void without(const Eigen::VectorXd& mode) {
    const Eigen::VectorXd unit = mode.normalized();
    samples_ -= unit * (unit.transpose() * samples_);
  }
  int cases_within(double error) const {
    int count = 0;
    for (Eigen::Index i = 0; i < samples_.cols(); ++i) count += largest_point(samples_.col(i)) <= error;
    return count;
  }

 private:
  Eigen::MatrixXd samples_;
};

/// The cases that are sums of modes where that is exact enough, all others as they are.
std::vector<StudyRecord> sums_of(const Coded& coded, const ScaledCases& cases, double error,
                                 const std::vector<StudyRecord>& own) {
  std::vector<StudyRecord> records = own;
  std::map<std::string, StudyRecord*> by_name;
  for (StudyRecord& one : records) by_name[one.name] = &one;
  const Eigen::LLT<Eigen::MatrixXd> normal(coded.samples.transpose() * coded.samples);
  for (int i = 0; i < cases.size(); ++i) {
    if (cases.apart(i)) continue;
    Eigen::VectorXd weights = normal.solve(coded.samples.transpose() * cases.samples().col(i));
    for (double& weight : weights) weight = std::round(weight * weights_per_unit) / weights_per_unit;
    const double off = largest_point(cases.samples().col(i) - coded.samples * weights);
    if (!(off <= error)) continue;
    StudyRecord& record = *by_name.at(cases.member(i).name);
    record.record = record_of_sum(cases.field(i), cases.slices());
    record.weights = {weights.begin(), weights.end()}, record.modes_error = off;
  }
  return records;
}

}  // namespace

std::size_t coefficient_bytes(const PackedStudy& study) {
  std::size_t bytes = 0;
  for (const auto& mode : study.modes.coefficients) bytes += mode.size();
  for (const StudyRecord& one : study.cases)
    bytes += one.record.coefficients.size() + bytes_of_weight * one.weights.size();
  return bytes;
}

PackedStudy with_common_modes(const std::vector<StudyMember>& members, const PackedStudy& own, double error) {
  CLEFT_CHECK(error, >, 0);
  const ScaledCases cases(members);
  const Eigen::MatrixXd weights = mode_weights(cases);
  Remainder remainder(cases);
  PackedStudy best = own;
  std::size_t fewest = coefficient_bytes(own);
  for (Eigen::Index count = 1, worse = 0; count <= cases.size() / 2 && worse < 4; ++count) {
    remainder.without(cases.samples() * weights.col(count - 1));
    if (2 * remainder.cases_within(error) < cases.size()) continue;
    const Coded coded = code(cases, weights.leftCols(count), error);
    PackedStudy packed{sums_of(coded, cases, error, own.cases), coded.modes};
    const std::size_t bytes = coefficient_bytes(packed);
    worse = bytes < fewest ? 0 : worse + 1;
    if (bytes < fewest) best = std::move(packed), fewest = bytes;
  }
  return 2 * fewest < coefficient_bytes(own) ? best : own;
}

}  // namespace cleft
