#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/text.h"
#include "encoder/field/file/study_file.h"
#include "explorer/wound/prestress_fields.h"
#include "tradeoff/chain.h"
#include "tradeoff/measures.h"
#include "tradeoff/replays/replay_error.h"

namespace cleft {

namespace {

const char* const error_label = "largest error of the opening / largest opening";

/// To micrometres.
std::string rounded(double length) { return shortest(std::round(length * 1e3) / 1e3); }

/// The case as a single straight, upright cut.
Parameters canonical(Parameters p) {
  p.cut.radius = p.cut.tilt = p.cut.branch = 0, p.cut.count = 1;
  return p;
}

/// The same cut under three independent prestresses, from which any other is superposed. (Shear alone would
/// compress the skin.)
PrestressFields prestress_fields(const ChartedCase& charted, const WorkFolder& work) {
  const double pull = std::max({charted.parameters.skin.prestress.uu, charted.parameters.skin.prestress.vv});
  std::vector<StudyRecord> records;
  for (const auto& [u, v, uv] : {std::array{pull, 0., 0.}, {0., pull, 0.}, {pull, pull, pull}}) {
    Parameters p = canonical(charted.parameters);
    p.skin.prestress = {u, v, uv};
    const Chain::Encoded encoded = Chain(p, work).encoded(charted.tolerance);
    records.push_back({"prestress" + std::to_string(records.size()), record_of(encoded.field)});
  }
  write_study(work + "/prestress.dffd", records);
  return PrestressFields(work + "/prestress.dffd");
}

class ReplayPanels {
 public:
  ReplayPanels(const ChartedCase& charted, const ChartOptions& options, WorkFolder work)
      : charted_(charted), options_(options), work_(std::move(work)) {}

  std::vector<Chart> measure() {
    options_.progress("solving the case itself");
    const Chain own(canonical(charted_.parameters), work_);
    field_ = own.encoded(charted_.tolerance).field;
    over_frame_time(own);
    if (is_linear_in_prestress(charted_.parameters)) fields_ = prestress_fields(charted_, work_);
    over_shapes();
    over_distances();
    return {frame_, radius_, tilt_, length_, spacing_};
  }

 private:
  void over_frame_time(const Chain& own) {
    const SnapshotReader truth(own.snapshot());
    const auto add = [&](const char* series, const std::string& setting, const ReplayError& e,
                         bool standard) {
      frame_.points.push_back({series, setting, 1e9 * e.frame_seconds / static_cast<double>(e.vertices),
                               e.skin_error / e.gape, standard});
    };
    std::vector<double> tolerances{0.1, 0.03, 0.01, 0.003};
    if (std::find(tolerances.begin(), tolerances.end(), charted_.tolerance) == tolerances.end())
      tolerances.push_back(charted_.tolerance);
    for (const double tolerance : tolerances) {
      options_.progress("replaying at tolerance " + shortest(tolerance));
      add("tolerance", "tolerance " + shortest(tolerance), replay_error(truth, own.encoded(tolerance).field),
          tolerance == charted_.tolerance);
    }
    for (const double detail : {0.003, 0.01, 0.03, 0.1})
      add("level of detail", "detail " + shortest(1e3 * detail) + " um", replay_error(truth, *field_, detail),
          false);
  }

  /// The truth of these parameters, against both replays of it.
  void add(Chart& chart, double x, const std::string& setting, const Parameters& parameters) {
    options_.progress("simulating a cut of " + setting);
    const auto put = [&](const char* series, const ReplayError& e) {
      if (e.gape > 0) chart.points.push_back({series, setting, x, e.gape_error / e.gape, false});
    };
    try {
      const SnapshotReader truth(Chain(parameters, work_).snapshot());
      if (parameters.cut.count > 1) return put("the case's field", parallel_error(truth, *field_));
      put("the case's field", replay_error(truth, *field_));
      if (fields_ && charted_.parameters.skin.prestress.uv == 0)
        put("tension turned", replay_error(truth, *fields_));
    } catch (const std::runtime_error& e) {
      options_.progress("left out, a cut of " + setting + ": " + e.what());
    }
  }

  void over_shapes() {
    const Parameters own = canonical(charted_.parameters);
    const double length = own.cut.length;
    for (const double factor : {0.5, 2 / 3., 1., 4 / 3., 2., 10 / 3., 20 / 3.}) {
      Parameters p = own;
      p.cut.radius = factor * length;
      add(radius_, p.cut.radius, "radius " + rounded(p.cut.radius) + " mm", p);
    }
    for (const double tilt : {15., 30., 45.}) {
      Parameters p = own;
      p.cut.tilt = tilt;
      add(tilt_, tilt, "tilt " + shortest(tilt) + " degrees", p);
    }
    for (const double factor : {0.2, 1 / 3., 0.5, 0.8, 4 / 3., 2., 3.}) {
      Parameters p = own;
      p.cut.length = factor * length, p.patch.length = own.patch.length - length + p.cut.length;
      add(length_, p.cut.length, "length " + rounded(p.cut.length) + " mm", p);
    }
  }

  /// In a wider patch, of the case's own cut too, so that its sides are not what differs.
  void over_distances() {
    Parameters own = canonical(charted_.parameters);
    own.patch.width += own.cut.length, own.mesh.grading = std::max(own.mesh.grading, 1.15);
    options_.progress("solving the case in a wider patch");
    field_ = Chain(own, work_).encoded(charted_.tolerance).field;
    for (const double factor : {2 / 15., 0.2, 1 / 3., 0.5, 2 / 3., 1.}) {
      Parameters p = own;
      p.cut.count = 2, p.cut.spacing = factor * own.cut.length;
      add(spacing_, p.cut.spacing, "distance " + rounded(p.cut.spacing) + " mm", p);
    }
  }

  const ChartedCase& charted_;
  const ChartOptions& options_;
  const WorkFolder work_;
  std::optional<Field> field_;
  std::optional<PrestressFields> fields_;
  Chart frame_{"replay.frame", "Replay: error over frame time", "time of a frame, ns a vertex of the skin",
               "largest error of the skin / largest opening", false};
  Chart radius_{"replay.radius",
                "Replay: error over curvature",
                "radius of the cut, mm",
                error_label,
                true,
                true,
                false};
  Chart tilt_{
      "replay.tilt", "Replay: error over tilt", "tilt of the blade, degrees", error_label, false, true,
      false};
  Chart length_{
      "replay.length", "Replay: error over length", "length of the cut, mm", error_label, true, true, false};
  Chart spacing_{"replay.spacing",
                 "Replay: two parallel cuts",
                 "distance of the cuts, mm",
                 error_label,
                 true,
                 true,
                 false};
};

}  // namespace

std::vector<Chart> replay_charts(const ChartedCase& charted, const ChartOptions& options,
                                 const WorkFolder& work) {
  return ReplayPanels(charted, options, work).measure();
}

}  // namespace cleft
