// cleft encode: a snapshot to its field.
#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "base/command.h"
#include "base/error.h"
#include "base/h5.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/field_file.h"
#include "encoder/field/field_record.h"

using namespace cleft;

namespace {

// What can be asked for. The same numbers stand in params/study.cpp, which refuses a study before it is
// solved and may not see the encoder.
constexpr std::array<int, 4> least_following_tip = {10, 8, 7, 4}, least_fixed = {4, 8, 4, 4};
constexpr int most_along_axis = 1000;
constexpr double most_control_points = 2e7;  // a file of 240 MB: no summary any more
constexpr double least_tolerance = 1e-9;

Json figures_of(const Field& field, const Snapshot& snapshot, const std::string& out) {
  const double raw = 3.0 * sizeof(float) * static_cast<double>(snapshot.points.size() * snapshot.frames());
  const double bytes = static_cast<double>(std::filesystem::file_size(out));
  Json figures = shown(field.report);
  figures.update(
      {{"control_points",
        {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()}},
       {"fit_seconds", field.report.fit_seconds},
       {"measure_seconds", field.report.measure_seconds},
       {"quantum_mm", field.quantum},
       {"parametrization", field.parametrization().name()},
       {"bytes", bytes},
       {"ratio_to_32_bit", raw / bytes}});
  figures["versions"] = {
      {"cleft", producer()},
      {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                    std::to_string(EIGEN_MINOR_VERSION)},
      {"HDF5", h5::version()}};
  for (const Quantity& quantity : field.quantities)
    figures["quantities"].push_back({{"name", quantity.name}, {"error", quantity.error}});
  return figures;
}

/// Spans of bases with about so many control points: as many as asked for where nothing is tied.
Rung rung_of(const std::vector<int>& counts, bool follows_tip) {
  if (counts.size() != 4) throw InputError("--control-points: expected four whole numbers U,V,W,T");
  const auto& least = follows_tip ? least_following_tip : least_fixed;
  double product = 1;
  for (int axis = 0; axis < 4; ++axis) {
    if (counts[axis] < least[axis])
      throw InputError(std::string("--control-points: ") + std::to_string(counts[axis]) +
                       " control points along " + "uvwt"[axis] + ": at least " + std::to_string(least[axis]));
    if (counts[axis] > most_along_axis)
      throw InputError(std::string("--control-points: ") + std::to_string(counts[axis]) +
                       " control points along " + "uvwt"[axis] + ": at most " +
                       std::to_string(most_along_axis));
    product *= counts[axis];
  }
  if (product > most_control_points)
    throw InputError("--control-points: " + shortest(product) + " in all; at most " +
                     shortest(most_control_points));
  Rung rung;
  rung.across = counts[1] / 2 - 3, rung.time = counts[3] - 3;
  if (follows_tip) {
    const int u = counts[0] - 7, w = counts[2] - 5;
    rung.before = std::max(1, u / 4), rung.after = std::max(1, u / 4),
    rung.along = u - rung.before - rung.after;
    rung.below = std::max(1, w / 3), rung.above = w - rung.below;
  } else {
    rung.along = counts[0] - 3, rung.above = counts[2] - 3;
  }
  return rung;
}

/// What was measured is what stands in the file; else there is none.
void verify_written(const std::string& out, const Field& field, const std::optional<NodeResidual>& residual) {
  const std::optional<NodeResidual> kept = read_residual(out);
  const bool same_residual =
      kept.has_value() == residual.has_value() &&
      (!kept || (kept->quantum == residual->quantum && kept->values == residual->values));
  if (same_residual && read_field(out).coefficients() == field.coefficients()) return;
  std::filesystem::remove(out);
  throw std::runtime_error(out + ": reads back as something else than was written, and was removed");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits a discontinuous free-form deformation to a snapshot.", "cleft encode");
  std::string snapshot, out;
  std::vector<int> counts;
  bool json = false;
  EncodeOptions options;
  app.add_option("CASE.h5", snapshot, "snapshot")->required();
  app.add_option("--out", out, "field to write, case.dffd")->required();
  auto* tolerance =
      app.add_option("--tolerance", options.tolerance,
                     "largest error at any node and frame over the largest displacement, at most")
          ->capture_default_str();
  app.add_option("--control-points", counts,
                 "U,V,W,T: control points along each axis instead of a tolerance, V for both sides together")
      ->delimiter(',')
      ->excludes(tolerance);
  app.add_option("--parametrization", options.parametrization,
                 "tip: knots follow the tip of the cut; fixed: they stay (the paper's)")
      ->check(CLI::IsMember(parametrization_names()))
      ->capture_default_str();
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    if (!(options.tolerance >= least_tolerance && options.tolerance < 1))
      throw InputError("--tolerance: " + shortest(options.tolerance) +
                       ": must be at least 1e-9 and less than 1");
    if (!counts.empty()) options.rung = rung_of(counts, options.parametrization != "fixed");
    refuse_to_overwrite(out, {snapshot});
    const OutputFile probe(out);  // a bad name is told before the work
    Progress progress("encoding");
    const SnapshotReader reader(snapshot);
    progress("reading");
    const Series series(reader);
    auto [field, residual] = encode(series, options, [&](const std::string& state) { progress(state); });
    for (const auto& [name, value] : reader.snapshot().parameters)
      if (const double* number = std::get_if<double>(&value)) field.parameters[name] = *number;
    field.case_hash = reader.snapshot().case_hash;
    progress("writing");
    write_field(out, field, residual ? &*residual : nullptr);
    verify_written(out, field, residual);
    print_figures(figures_of(field, reader.snapshot(), out), json);
  });
}
