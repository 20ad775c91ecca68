#include <algorithm>
#include <numeric>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"
#include "tradeoff/measures.h"
#include "tradeoff/rivals/zfp_rival.h"

namespace cleft {

namespace {

constexpr double charted_tolerances[] = {0.08, 0.04, 0.02, 0.01, 0.005, 0.001, 1e-4};

/// Time of the spline at all nodes, in their order, in a frame: ns a point, the least of some times, and the
/// median over the frames.
double point_nanoseconds(const Field& field, const Series& series) {
  std::vector<Place> places;
  std::vector<double> times;
  std::vector<Vec3> out(series.samples.size());
  for (const double t : series.times) {
    places.clear();
    for (const Sample& sample : series.samples) places.push_back({sample.uvw, sample.side, t});
    const double seconds = least_seconds(5, [&] { field.displacements(places, out); });
    times.push_back(1e9 * seconds / static_cast<double>(places.size()));
  }
  return median(times);
}

struct EncoderPanels {
  Chart size{"encoder.size", "Encoded case: error over size", "bytes of the case",
             "largest error / largest displacement"};
  Chart fit{"encoder.fit", "Encoding: error over time", "time to fit, s",
            "largest error / largest displacement"};
  Chart point{"encoder.point", "Evaluation: error over time", "time for a point, ns",
              "largest error / largest displacement"};
};

void add_ours(EncoderPanels& panels, const Series& series, const ChartedCase& charted,
              const std::string& parametrization, std::vector<double>& reached) {
  std::vector<double> all(std::begin(charted_tolerances), std::end(charted_tolerances));
  if (std::find(all.begin(), all.end(), charted.tolerance) == all.end()) all.push_back(charted.tolerance);
  for (const double tolerance : all) {
    EncodeOptions options;
    options.parametrization = parametrization, options.tolerance = tolerance;
    Stopwatch watch;
    const Encoded encoded = encode(series, options, [](const std::string&) {});
    const Field& field = encoded.field;
    const double seconds = watch.lap();
    double bytes = static_cast<double>(record_of(field).coefficients.size());
    if (encoded.residual) bytes += static_cast<double>(encoded.residual->bytes());
    const bool standard = tolerance == charted.tolerance && parametrization == charted.parametrization;
    const std::string setting = "tolerance " + shortest(tolerance);
    panels.size.points.push_back({parametrization, setting, bytes, field.report.node_error, standard});
    panels.fit.points.push_back({parametrization, setting, seconds, field.report.node_error, standard});
    panels.point.points.push_back(
        {parametrization, setting, point_nanoseconds(field, series), field.report.spline_error, standard});
    if (parametrization == charted.parametrization) reached.push_back(field.report.node_error);
  }
}

void add_zfp(EncoderPanels& panels, const Series& series, const std::vector<double>& errors) {
  if (!zfp_is_there()) return;
  const NodeData data(series);
  std::vector<int> order(data.nodes);
  std::iota(order.begin(), order.end(), 0);
  for (const double error : errors) {
    if (!(error > 0)) continue;
    const Compressed c = zfp_within(data, order, Goal::node_error, error);
    panels.size.points.push_back({"zfp", "error " + shortest(error), c.bytes, c.errors.node_error});
    panels.point.points.push_back(
        {"zfp", "error " + shortest(error), c.nanoseconds_a_point, c.errors.node_error});
  }
}

}  // namespace

std::vector<Chart> encoder_charts(const ChartedCase& charted, const ChartOptions& options) {
  options.progress("reading " + charted.snapshot);
  const SnapshotReader reader(charted.snapshot);
  const Series series(reader);
  EncoderPanels panels;
  std::vector<double> reached;
  for (const std::string& parametrization : parametrization_names()) {
    options.progress("encoding with " + parametrization);
    add_ours(panels, series, charted, parametrization, reached);
  }
  options.progress("compressing with zfp");
  add_zfp(panels, series, reached);
  return {panels.size, panels.fit, panels.point};
}

}  // namespace cleft
