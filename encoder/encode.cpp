#include "encoder/encode.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "encoder/parallel.h"
#include "encoder/series_fit.h"

namespace cleft {

namespace {

// What of the tolerance fits of single frames and of all frames may use up, and what steps of the coefficients
// would in the worst case.
constexpr double share_of_space = 0.9, share_of_fit = 0.95, share_of_steps = 0.15;
constexpr int probes = 6;  // frames that stand for all while knots are sought

class Encoder {
 public:
  Encoder(const Series& series, const EncodeOptions& options,
          const std::function<void(const std::string&)>& progress)
      : series_(series), options_(options), progress_(progress) {
    const bool cut = series.geometry.cut.length > 0;
    parametrization_ = make_parametrization(cut ? options.parametrization : "fixed", series.geometry);
    scale_ = series.largest_displacement > 0 ? series.largest_displacement : 1;
    limit_ = options.tolerance * scale_;
  }

  Field run() {
    if (options_.rung) return with_steps(fit_of(*options_.rung), true);
    const std::vector<Rung> rungs = ladder_of(*parametrization_);
    for (std::size_t i = first_within(rungs);; ++i) {
      progress_("fitting all frames");
      const SeriesFit fit = fit_of(rungs[i]);
      const bool last = i + 1 == rungs.size();
      if (last || fit.error(fit.control_points()) <= share_of_fit * limit_) return with_steps(fit, last);
    }
  }

 private:
  SeriesFit fit_of(const Rung& rung) const {
    return {series_, parametrization_, bases_of(rung, *parametrization_, static_cast<int>(series_.times.size()))};
  }

  /// Index of the first rung whose fits in space of a few frames keep their share of the tolerance.
  std::size_t first_within(const std::vector<Rung>& rungs) const {
    const int frames = static_cast<int>(series_.times.size());
    std::vector<int> some;
    for (int i = 0; i < probes; ++i) some.push_back(1 + (frames - 2) * i / (probes - 1));
    some.erase(std::unique(some.begin(), some.end()), some.end());
    std::size_t low = 0, high = rungs.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      progress_("trying knots");
      const auto bases = bases_of(rungs[middle], *parametrization_, frames);
      if (space_error(series_, parametrization_, {bases[0], bases[1], bases[2]}, some) <= share_of_space * limit_)
        high = middle;
      else
        low = middle + 1;
    }
    return low;
  }

  /// The field with steps of its coefficients that cost a share of the tolerance, or of the error where knots or
  /// wishes leave it larger.
  Field with_steps(const SeriesFit& fit, bool whatever_the_error) const {
    progress_("choosing the coefficients' steps");
    const Eigen::MatrixXd& exact = fit.control_points();
    const double error = fit.error(exact);
    const double bound = whatever_the_error && (options_.rung || error > limit_) ? 1.02 * error : limit_;
    const auto rounded = [&](double step) { return Eigen::MatrixXd((exact / step).array().round() * step); };
    // Functions sum to 1: coefficients off by half a step each way put no point off by more than sqrt(3) / 2 steps.
    double step = share_of_steps * 2 / std::sqrt(3.) * std::max(bound, 1e-9 * scale_);
    while (fit.error(rounded(step)) > bound && step > bound / 1000) step /= 1.5;
    Field field = fit.field(rounded(step));
    field.quantum = step;
    field.report.condition = fit.condition();
    return field;
  }

  const Series& series_;
  const EncodeOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  std::shared_ptr<const Parametrization> parametrization_;
  double scale_ = 1, limit_ = 0;
};

}  // namespace

Field encode(const Series& series, const EncodeOptions& options,
             const std::function<void(const std::string&)>& progress) {
  return Encoder(series, options, progress).run();
}

FitReport measure(const Field& field, const Series& series, const Snapshot& s) {
  struct Frame {
    double squared_error = 0, squared_data = 0, worst = 0, gape = 0, false_gap = 0;
    int worst_node = 0;
  };
  const auto& samples = series.samples;
  std::vector<Frame> frames(series.times.size());
  parallel_for(static_cast<int>(frames.size()), [&](int j) {
    Frame& f = frames[j];
    const double t = series.times[j];
    std::vector<Vec3> off(samples.size());
    for (std::size_t n = 0; n < samples.size(); ++n) {
      const auto row = series.frames[j].row(static_cast<Eigen::Index>(n));
      const Vec3 d{row(0), row(1), row(2)};
      off[n] = field.displacement(samples[n].uvw, samples[n].side, t) - d;
      const double error = squared_norm(off[n]);
      f.squared_error += error, f.squared_data += squared_norm(d);
      if (error > f.worst) f.worst = error, f.worst_node = static_cast<int>(n);
      if (samples[n].uvw.y == 0 && samples[n].side == Side::both)
        f.false_gap = std::max(f.false_gap, norm(field.displacement(samples[n].uvw, Side::right, t) -
                                                 field.displacement(samples[n].uvw, Side::left, t)));
    }
    for (std::size_t p = 0; p < s.pairs.size(); ++p) {
      const double error =
          norm(off[static_cast<std::size_t>(s.pairs[p][1])] - off[static_cast<std::size_t>(s.pairs[p][0])]);
      double& kind =
          static_cast<std::int32_t>(p) < s.released[static_cast<std::size_t>(j)] ? f.gape : f.false_gap;
      kind = std::max(kind, error);
    }
  });
  FitReport report = field.report;
  report.largest_displacement = series.largest_displacement;
  if (series.largest_displacement == 0) return report;  // nothing moves: every figure is 0
  double squared_error = 0, squared_data = 0, worst = 0;
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const Frame& f = frames[j];
    squared_error += f.squared_error, squared_data += f.squared_data;
    if (f.worst > worst)
      worst = f.worst, report.worst_node = f.worst_node, report.worst_time = series.times[j];
    report.gape_error = std::max(report.gape_error, f.gape / report.largest_displacement);
    report.false_gap = std::max(report.false_gap, f.false_gap / report.largest_displacement);
    if (series.largest[j] > 0)
      report.frame_error = std::max(report.frame_error, std::sqrt(f.worst) / series.largest[j]);
  }
  report.relative_l2 = std::sqrt(squared_error / squared_data);
  report.node_error = report.spline_error = std::sqrt(worst) / report.largest_displacement;
  return report;
}

}  // namespace cleft
