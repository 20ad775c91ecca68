#include "explorer/web/between_cases_data.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/quantiles.h"
#include "encoder/field/file/field_record.h"
#include "encoder/field/unknowns.h"
#include "encoder/interpolate/case_modes.h"
#include "encoder/interpolate/field_samples.h"
#include "explorer/web/little_endian.h"

namespace cleft {

namespace {

// Errors of modes over that of the fits: of few modes, and of many.
constexpr double share_of_few = 0.05, share_of_many = 0.2;
constexpr int many_modes = 32;
constexpr double share_of_steps = 0.5;  // of their rounding in it
constexpr int most_compared = 64;

/// The largest part of a case that each mode is, over the case's largest displacement.
Eigen::VectorXd sizes_of(const CommonCases& cases, const Eigen::MatrixXd& shares,
                         const std::vector<StudyInterpolator::Range>& varying) {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(shares.rows());
  const auto add = [&](Eigen::Index column, double unit) {
    if (unit > 0 && std::isfinite(unit)) sizes = sizes.cwiseMax(shares.col(column).cwiseAbs() / unit);
  };
  const auto largest = [&](int i) {
    return cases.cases()[static_cast<std::size_t>(i)].report.largest_displacement;
  };
  for (int i = 0; i < cases.size(); ++i) add(i, largest(i));
  for (std::size_t d = 0; d < cases.derivatives().size(); ++d)
    for (const auto& [name, least, greatest] : varying)
      if (name == cases.derivatives()[d].parameter)
        add(cases.size() + static_cast<Eigen::Index>(d),
            largest(cases.derivatives()[d].of) / (greatest - least));
  return sizes;
}

/// The largest distance of sums of coded modes from the cases, at places, over their largest displacement.
double largest_error(const CommonCases& cases, const Eigen::MatrixXd& modes, const Eigen::MatrixXd& shares,
                     const CommonPlaces& places) {
  std::vector<RecordedParameters> parameters;
  for (const CommonCase& one : cases.cases()) parameters.push_back(one.parameters);
  double error = 0;
  for (const int i : representative_cases(parameters, most_compared)) {
    const double largest = cases.cases()[static_cast<std::size_t>(i)].report.largest_displacement;
    if (!(largest > 0)) continue;
    const Eigen::VectorXd own = sample_cases(cases, places, {i}).col(0);
    error = std::max(error, largest_point(own - modes * shares.col(i)) / largest);
  }
  return error;
}

void add_modes(const StudyInterpolator& interpolator, Json& model, BetweenCasesData& data) {
  const CommonCases& cases = interpolator.cases();
  const double fit = std::max(2e-3, model.at("fit_error").get<double>()), allowed = share_of_few * fit;
  const CaseModes modes(interpolator, allowed, share_of_many * fit, many_modes);
  const Eigen::VectorXd sizes = sizes_of(cases, modes.shares(), interpolator.varying());
  const double quantum = share_of_steps * allowed * std::sqrt(12. / std::max(1, modes.count()));
  const ControlTies ties = ties_of(cases.parametrization(), cases.bases());
  const CoefficientGrid grid = places_of(ties, cases.bases());
  const CommonPlaces places = places_in_common(cases);
  Eigen::MatrixXd shares = modes.shares(), samples(3 * std::ssize(places.places), modes.count());
  data.pieces.emplace_back();
  Json slices = Json::array();
  for (int k = 0; k < modes.count(); ++k) {
    const double unit = sizes[k] > 0 ? quantum / sizes[k] : quantum;  // mm of a mode for one step
    const Unknowns unknowns = unknowns_of(points_of(modes.mode(k)), cases.bases()[3], grid, unit);
    const auto integers = round_coefficients(grid, unknowns.slices, unknowns.values, 0.5);
    data.pieces.push_back(encode_coefficients(grid, unknowns.slices, integers));
    slices.push_back(unknowns.slices);
    samples.col(k) = sample(cases, control_points(ties, cases.bases(), integers, quantum), places);
    shares.row(k) *= unit / quantum;
  }
  for (Eigen::Index k = 0; k < shares.rows(); ++k)
    for (const double share : shares.row(k)) append(data.pieces.front(), static_cast<float>(share));
  data.modes = modes.count();
  data.error = largest_error(cases, samples, shares, places);
  Json bytes = Json::array();
  for (const auto& piece : data.pieces) bytes.push_back(piece.size());
  model["modes"] = {{"bytes", bytes}, {"slices", slices}, {"quantum", quantum}, {"error", data.error}};
}

}  // namespace

BetweenCasesData between_cases_data(const PublishedStudy& study, bool modes) {
  BetweenCasesData data;
  try {
    const StudyInterpolator interpolator(study.path());
    for (const auto& [name, least, greatest] : interpolator.varying())
      if (name != on_bone_name &&
          std::find(study.varying().begin(), study.varying().end(), name) == study.varying().end())
        throw InputError(name + " was asked to be the same in all cases, and is not");
    Json model = interpolator.data();
    if (!modes && !interpolator.cases().derivatives().empty())
      throw InputError(
          "its cases have derivatives by parameters, which are known of fields and not of a mesh");
    if (modes) add_modes(interpolator, model, data);
    data.model = model.dump();
  } catch (const FileError&) {
    throw;
  } catch (const InputError& e) {
    data = {};
    data.reason = e.what();
  }
  return data;
}

}  // namespace cleft
