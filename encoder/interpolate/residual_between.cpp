#include "encoder/interpolate/residual_between.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"

namespace cleft {

namespace {

/// Materials and loads vary alone, so that all cases have the nodes of one mesh.
bool of_one_mesh(const StudyInterpolator& interpolator) {
  const auto shapes = [](const StudyInterpolator::Range& range) {
    return range.name.starts_with("cut.") || range.name.starts_with("patch.") ||
           range.name.starts_with("mesh.");
  };
  const auto& varying = interpolator.varying();
  const auto& cases = interpolator.cases().cases();
  return std::none_of(varying.begin(), varying.end(), shapes) &&
         std::all_of(cases.begin(), cases.end(),
                     [&](const CommonCase& one) { return one.geometry == cases.front().geometry; });
}

/// The sum of residuals, each times a weight.
class ResidualSum {
 public:
  /// Whether it is at the nodes and frames of those before.
  bool add(double weight, const NodeResidual& one) {
    if (sum_.empty()) {
      all_.nodes = one.nodes, all_.frames = one.frames;
      all_.components = one.components, all_.first_frame = one.first_frame;
      sum_.resize(one.values.size());
    }
    if (one.nodes != all_.nodes || one.frames != all_.frames) return false;
    finest_ = std::min(finest_, one.quantum);
    for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += weight * one.quantum * one.values[k];
    return true;
  }
  /// In the finest steps of its parts.
  std::optional<CodedResidual> in_steps() {
    if (sum_.empty()) return std::nullopt;
    all_.quantum = finest_, all_.values = SmallIntegers(sum_.size());
    for (std::size_t k = 0; k < sum_.size(); ++k)
      all_.values.set(k, static_cast<std::int32_t>(std::lround(sum_[k] / finest_)));
    return coded(all_);
  }

 private:
  NodeResidual all_;
  std::vector<double> sum_;
  double finest_ = std::numeric_limits<double>::infinity();
};

std::optional<CodedResidual> residual_between(const StudyInterpolator& interpolator, const std::string& study,
                                              const Eigen::VectorXd& weights) {
  const CommonCases& cases = interpolator.cases();
  if (!std::filesystem::is_directory(study) || !cases.derivatives().empty() || !of_one_mesh(interpolator))
    return std::nullopt;
  std::map<std::string, std::string> files;
  std::vector<std::string> damaged;  // these are no cases of the study
  for (const StudyCase& one : published_study_cases(study, nullptr, &damaged))
    files[one.name] = one.field_file;
  ResidualSum sum;
  for (int i = 0; i < cases.size(); ++i) {
    const auto file = files.find(cases.cases()[i].name);
    if (file == files.end()) return std::nullopt;  // a mirror image, whose nodes are others
    if (const auto one = read_residual(file->second); one && weights[i] != 0)
      if (!sum.add(weights[i], *one)) return std::nullopt;
  }
  return sum.in_steps();
}

}  // namespace

Encoded between_with_nodes(const StudyInterpolator& interpolator, const std::string& study,
                           const CaseParameters& values) {
  const StudyInterpolator::Recipe recipe = interpolator.recipe(values);
  Encoded between{interpolator.field_of(recipe)};
  between.residual = residual_between(interpolator, study, recipe.prediction.weights);
  if (between.residual)
    between.field.report.node_error = interpolator.estimated_error(
        recipe, between.field.report.largest_displacement, &FitReport::node_error);
  return between;
}

}  // namespace cleft
