#include "encoder/modes/common_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/parallel.h"
#include "encoder/field/unknowns.h"
#include "encoder/interpolate/common_cases.h"
#include "encoder/interpolate/field_samples.h"

namespace cleft {

namespace {

// What the steps of all modes together may do to a case, over the error allowed.
constexpr double share_of_steps = 0.25;
constexpr double farthest_move = 0.65;      // steps, that a control point of a case moves
constexpr double weights_per_unit = 1e5;    // modes are as large as the cases
constexpr std::size_t bytes_of_weight = 3;  // deflated
// Rows of samples that are in double precision at a time: of whole points.
constexpr Eigen::Index block_rows = 3 * 256;

bool displaces_alone(const StudyRecord& one) {
  const Json& header = one.record.header;
  return !header.contains("quantities") && !header.contains("by_parameter") &&
         report_of(header).largest_displacement > 0;
}

/// Those that may become sums of modes.
std::vector<const StudyRecord*> displacements_alone(const std::vector<StudyRecord>& cases) {
  std::vector<const StudyRecord*> list;
  for (const StudyRecord& one : cases)
    if (displaces_alone(one)) list.push_back(&one);
  return list;
}

/// The cases on common knots, and samples of each over its largest displacement. What there is of every case
/// is in single precision.
class ScaledCases {
 public:
  explicit ScaledCases(const std::vector<const StudyRecord*>& records)
      : common_(CommonCases::of_records(records)),
        places_(places_in_common(common_)),
        grid_(places_of(ties(), common_.bases())),
        slices_(static_cast<std::size_t>(size())),
        samples_(static_cast<Eigen::Index>(3 * places_.places.size()), size()) {
    parallel_for(size(), [&](int i) {
      const std::vector<Vec3> points = common_.points(i);
      slices_[i] = unknowns(points).slices;
      samples_.col(i) = (sample(common_, points, places_) / largest(i)).cast<float>();
    });
    for (int i = 0; i < size(); ++i)
      if (apart(i)) samples_.col(i).setZero();
  }

  int size() const { return common_.size(); }
  const std::string& name(int i) const { return kept(i).name; }
  /// Never a sum of modes: its samples are 0.
  bool apart(int i) const { return slices_[i] != slices(); }
  const CoefficientGrid& grid() const { return grid_; }
  int slices() const { return slices_.front(); }
  const Eigen::MatrixXf& samples() const { return samples_; }

  /// A sum of the scaled cases: its unknowns.
  std::vector<double> sum(const Eigen::VectorXd& weights) const {
    std::vector<Summand> summands;
    for (int i = 0; i < size(); ++i)
      summands.push_back({apart(i) ? 0 : weights[i] / largest(i), common_.control_points(i)});
    Unknowns sum = unknowns(sum_of(summands));
    if (sum.slices != slices()) sum.values.assign(3ul * slices() * grid_.unknowns, 0);  // all of it is 0
    return std::move(sum.values);
  }
  Eigen::VectorXd samples_of(const std::vector<double>& unknowns) const {
    return sample(common_, control_points(ties(), common_.bases(), unknowns), places_);
  }
  FieldRecord record_of_sum(int i, const FieldRecord& own) const {
    return cleft::record_of_sum(own.header, common_.bases_in(kept(i).geometry), slices());
  }

 private:
  const CommonCase& kept(int i) const { return common_.cases()[i]; }
  double largest(int i) const { return kept(i).report.largest_displacement; }
  ControlTies ties() const { return ties_of(common_.parametrization(), common_.bases()); }
  Unknowns unknowns(const std::vector<Vec3>& points) const {
    return unknowns_of(points, common_.bases()[3], grid_, 1);
  }

  CommonCases common_;
  CommonPlaces places_;
  CoefficientGrid grid_;
  std::vector<int> slices_;
  Eigen::MatrixXf samples_;
};

/// Calls work(first row, block) for one block of all cases' samples after another.
template <class Number, class Work>
void for_each_block(const Eigen::MatrixXf& samples, const Work& work) {
  for (Eigen::Index row = 0; row < samples.rows(); row += block_rows)
    work(row, Eigen::MatrixX<Number>(
                  samples.middleRows(row, std::min(block_rows, samples.rows() - row)).cast<Number>()));
}

/// The largest points so far in each column, raised to those of a block.
template <class Number>
void raise_to(Eigen::VectorX<Number>& largest, const Eigen::MatrixX<Number>& block) {
  for (Eigen::Index i = 0; i < block.cols(); ++i) {
    const Eigen::Map<const Eigen::Matrix3X<Number>> points(block.col(i).data(), 3, block.rows() / 3);
    largest[i] = std::max(largest[i], std::sqrt(points.colwise().squaredNorm().maxCoeff()));
  }
}

/// The right singular vectors of the samples, leading first.
Eigen::MatrixXd singular_vectors(const Eigen::MatrixXf& samples) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(samples.cols(), samples.cols());
  for_each_block<double>(samples, [&](Eigen::Index, const Eigen::MatrixXd& block) {
    normal.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
  });
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(normal).eigenvectors().rowwise().reverse();
}

/// Whether half the cases are within the error when the modes of these vectors take of them what they can.
bool serve_half(const Eigen::MatrixXf& vectors, const Eigen::MatrixXf& samples, double error) {
  Eigen::VectorXf largest = Eigen::VectorXf::Zero(samples.cols());
  for_each_block<float>(samples, [&](Eigen::Index, Eigen::MatrixXf block) {
    const Eigen::MatrixXf modes = block * vectors;
    block.noalias() -= modes * vectors.transpose();
    raise_to(largest, block);
  });
  return 2 * (largest.array() <= static_cast<float>(error)).count() >= samples.cols();
}

/// The fewest modes that serve half the cases; none where as many as `most` do not.
Eigen::Index fewest_modes(const Eigen::MatrixXd& vectors, const Eigen::MatrixXf& samples, Eigen::Index most,
                          double error) {
  const auto serve = [&](Eigen::Index count) {
    return serve_half(vectors.leftCols(count).cast<float>(), samples, error);
  };
  Eigen::Index too_few = 0, enough = 1;
  while (!serve(enough)) {
    if (enough == most) return 0;
    too_few = enough, enough = std::min(2 * enough, most);
  }
  while (enough - too_few > 1) {
    const Eigen::Index middle = (too_few + enough) / 2;
    (serve(middle) ? enough : too_few) = middle;
  }
  return enough;
}

/// Modes as they are stored.
struct Coded {
  CodedModes modes;
  Eigen::MatrixXd samples;
};

/// Scales each mode to its mean contribution to a case, and drops modes below one quantum.
Coded code(const ScaledCases& cases, const Eigen::MatrixXd& vectors, double error) {
  const double quantum = share_of_steps * error * std::sqrt(12. / static_cast<double>(vectors.cols()));
  Coded coded;
  coded.samples.resize(cases.samples().rows(), vectors.cols());
  Eigen::Index k = 0;
  for (; k < vectors.cols(); ++k) {
    std::vector<double> values = cases.sum(vectors.col(k) / std::sqrt(static_cast<double>(cases.size())));
    for (double& value : values) value /= quantum;
    const auto integers = round_coefficients(cases.grid(), cases.slices(), values, 0.5);
    const bool zero = std::all_of(integers.begin(), integers.end(), [](auto n) { return n == 0; });
    if (k > 0 && zero) break;
    coded.modes.quanta.push_back(quantum);
    coded.modes.coefficients.push_back(encode_coefficients(cases.grid(), cases.slices(), integers));
    coded.samples.col(k) = cases.samples_of(multiples(integers, quantum));
  }
  coded.samples.conservativeResize(Eigen::NoChange, k);
  return coded;
}

/// Of all cases as sums of modes, a column for each.
struct Fit {
  Eigen::MatrixXd weights;  // as they are stored
  Eigen::VectorXd off;      // largest error, over the largest displacement, rounding included
};

Fit fit(const Eigen::MatrixXd& modes, const Eigen::MatrixXf& samples) {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(modes.cols(), samples.cols());
  for_each_block<double>(samples, [&](Eigen::Index row, const Eigen::MatrixXd& block) {
    right.noalias() += modes.middleRows(row, block.rows()).transpose() * block;
  });
  Fit fit{(modes.transpose() * modes).ldlt().solve(right), Eigen::VectorXd::Zero(samples.cols())};
  fit.weights = (fit.weights * weights_per_unit).array().round() / weights_per_unit;
  for_each_block<double>(samples, [&](Eigen::Index row, Eigen::MatrixXd block) {
    block.noalias() -= modes.middleRows(row, block.rows()) * fit.weights;
    raise_to(fit.off, block);
  });
  fit.off.array() += static_cast<double>(std::numeric_limits<float>::epsilon());
  return fit;
}

std::vector<Vec3> displacements(const Field& field, const std::vector<Place>& places) {
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  return values;
}

/// The largest distance between two lists of displacements, mm.
double farthest_apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double farthest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) farthest = std::max(farthest, squared_norm(a[n] - b[n]));
  return std::sqrt(farthest);
}

/// The case with control points in the coarsest steps that move no node by more than the error, if these need
/// fewer bytes.
StudyRecord in_coarser_steps(const StudyRecord& own, double error) {
  constexpr double near_enough = 0.98;  // of the error, that nodes move by
  constexpr int most_tries = 10;
  const Field field = field_of(own.record);
  const FieldGeometry& geometry = field.parametrization().geometry();
  const std::vector<Place> nodes = sample_places(geometry, node_spacing(field.parameters, geometry));
  const std::vector<Vec3> exact = displacements(field, nodes);
  const double largest = field.report.largest_displacement, bound = error * largest;
  StudyRecord record = own;
  // Control points half a step off each way are off by sqrt(3) / 2 steps, and nodes, which are among several
  // of them, by about half as much. That is nearly in proportion to the step.
  double step = 2 * bound, kept = 0;
  for (int i = 0; i < most_tries; ++i) {
    const Field coarser = quantised(field, step, farthest_move);
    const double off = farthest_apart(displacements(coarser, nodes), exact);
    if (off <= bound && step > kept)
      kept = step, record.record = record_of(coarser), record.modes_error = off / largest;
    if (off > near_enough * bound && off <= bound) break;
    step = std::clamp((1 + near_enough) / 2 * bound / off, 0.3, 2.) * step;
    if (step <= kept) break;
  }
  return record.record.coefficients.size() < own.record.coefficients.size() ? record : own;
}

/// The cases that are sums of modes where that is exact enough, all others as `own` has them.
std::vector<StudyRecord> sums_of(const Coded& coded, const ScaledCases& cases, double error,
                                 const std::vector<StudyRecord>& own) {
  std::vector<StudyRecord> records = own;
  std::map<std::string, StudyRecord*> by_name;
  for (StudyRecord& one : records) by_name[one.name] = &one;
  const Fit fit = cleft::fit(coded.samples, cases.samples());
  for (int i = 0; i < cases.size(); ++i) {
    if (cases.apart(i) || !(fit.off[i] <= error)) continue;
    StudyRecord& one = *by_name.at(cases.name(i));
    one.record = cases.record_of_sum(i, one.record);  // of its header
    one.weights = {fit.weights.col(i).begin(), fit.weights.col(i).end()}, one.modes_error = fit.off[i];
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

PackedStudy with_common_modes(const PackedStudy& own, double error) {
  CLEFT_CHECK(error, >, 0);
  const std::vector<const StudyRecord*> records = displacements_alone(own.cases);
  if (records.size() < 2 && own.cases.size() >= 2) return own;
  PackedStudy coarser = own;
  parallel_for(static_cast<int>(coarser.cases.size()), [&](int i) {
    if (displaces_alone(own.cases[i])) coarser.cases[i] = in_coarser_steps(own.cases[i], error);
  });
  const ScaledCases cases(records);
  const Eigen::MatrixXd vectors = singular_vectors(cases.samples());
  const Eigen::Index most = std::max(1, cases.size() - 1),
                     fewest = fewest_modes(vectors, cases.samples(), most, error);
  PackedStudy best;
  std::size_t fewest_bytes = std::numeric_limits<std::size_t>::max();
  for (Eigen::Index count = std::max<Eigen::Index>(fewest, 1), worse = 0;
       fewest > 0 && count <= most && worse < 4; count += std::max<Eigen::Index>(1, count / 16)) {
    const Coded coded = code(cases, vectors.leftCols(count), error);
    PackedStudy packed{sums_of(coded, cases, error, coarser.cases), coded.modes};
    const std::size_t bytes = coefficient_bytes(packed);
    worse = bytes < fewest_bytes ? 0 : worse + 1;
    if (bytes < fewest_bytes) best = std::move(packed), fewest_bytes = bytes;
  }
  return fewest_bytes < coefficient_bytes(coarser) ? best : coarser;
}

}  // namespace cleft
