// cleft encode: a snapshot to its field.
#include <Eigen/Core>
#include <filesystem>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "base/memory.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"
#include "params/encode_limits.h"

using namespace cleft;

namespace {

Json figures_of(const Field& field, const std::string& out) {
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
       {"ratio_to_32_bit", field.report.raw_bytes() / bytes}});
  figures["versions"] = {
      {"cleft", producer()},
      {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                    std::to_string(EIGEN_MINOR_VERSION)},
      {"HDF5", h5::version()}};
  for (const Quantity& quantity : field.quantities)
    figures["quantities"].push_back(
        {{"name", quantity.name}, {"error", quantity.error}, {"spline_error", quantity.spline_error}});
  for (const ParameterDerivative& one : field.by_parameter)
    figures["by_parameter"].push_back({{"parameter", one.parameter}, {"error", one.error}});
  return figures;
}

/// Spans of bases with about so many control points: as many as requested if nothing is tied.
Rung rung_of(const std::vector<int>& counts, bool follows_tip) {
  if (counts.size() != 4) throw InputError("--control-points: expected four whole numbers U,V,W,T");
  check_control_points({counts[0], counts[1], counts[2], counts[3]}, follows_tip ? "front" : "fixed",
                       "--control-points");
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

/// The report is that of the file's content; otherwise no file is written.
void verify_written(const std::string& out, const Encoded& encoded) {
  const auto same = [](const std::optional<NodeResidual>& kept, const std::optional<NodeResidual>& residual) {
    return kept.has_value() == residual.has_value() &&
           (!kept || (kept->quantum == residual->quantum && kept->values == residual->values));
  };
  const Field kept = read_field(out), &field = encoded.field;
  bool good = kept.coefficients() == field.coefficients() && same(read_residual(out), encoded.residual) &&
              kept.quantities.size() == field.quantities.size() &&
              kept.by_parameter.size() == field.by_parameter.size();
  for (std::size_t q = 0; good && q < field.quantities.size(); ++q)
    good = kept.quantities[q].coefficients == field.quantities[q].coefficients &&
           same(read_quantity_residual(out, q), encoded.of_quantities[q]);
  for (std::size_t d = 0; good && d < field.by_parameter.size(); ++d)
    good = kept.by_parameter[d].control_points == field.by_parameter[d].control_points;
  if (good) return;
  std::filesystem::remove(out);
  throw std::runtime_error(out + ": reads back as something else than was written, and was removed");
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_blocks();
  CommandLine app("Fits a discontinuous free-form deformation to a snapshot.", "cleft encode");
  std::string snapshot, out;
  std::vector<int> counts;
  bool json = false;
  EncodeOptions options;
  app.add_option("CASE.h5", snapshot, "snapshot")->required();
  app.add_option("--out", out, "field to write, case.dffd")->required();
  auto* tolerance =
      app.add_option(
             "--tolerance", options.tolerance,
             "largest error at any node and frame over the largest displacement (of a further quantity: over "
             "its largest value), at most")
          ->capture_default_str();
  app.add_option("--control-points", counts,
                 "U,V,W,T: control points along each axis instead of a tolerance, V for both sides together")
      ->delimiter(',')
      ->excludes(tolerance);
  app.add_option(
         "--parametrization", options.parametrization,
         "front: knots follow the front of the cut, dense as the lips close there; tip: evenly dense; fixed: "
         "they stay (the paper's)")
      ->check(one_of(parametrization_names()))
      ->capture_default_str();
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    if (!(options.tolerance >= least_tolerance && options.tolerance < 1))
      throw InputError("--tolerance: " + shortest(options.tolerance) +
                       ": must be at least 1e-9 and less than 1");
    if (!counts.empty()) options.rung = rung_of(counts, options.parametrization != "fixed");
    refuse_to_overwrite(out, {snapshot});
    const OutputFile probe(out);  // reports a bad name before the work
    Progress progress("encoding");
    const SnapshotReader reader(snapshot);
    progress("reading");
    const Series series(reader);
    Encoded encoded = encode(series, options, [&](const std::string& state) { progress(state); });
    Field& field = encoded.field;
    field.parameters = reader.snapshot().parameters;
    field.case_hash = reader.snapshot().case_hash;
    progress("writing");
    write_field(out, field, encoded.residual ? &*encoded.residual : nullptr, {}, encoded.of_quantities);
    verify_written(out, encoded);
    print_figures(figures_of(field, out), json);
  });
}
