// cleft encode: a snapshot to its field.
#include <filesystem>

#include "base/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/field_file.h"

using namespace cleft;

namespace {

constexpr double most_control_points = 2e7;  // a file of 240 MB: no summary any more

Json figures_of(const Field& field, const Snapshot& snapshot, const std::string& out) {
  const FitReport& r = field.report;
  const double raw = 3.0 * sizeof(float) * static_cast<double>(snapshot.points.size() * snapshot.frames());
  const double bytes = static_cast<double>(std::filesystem::file_size(out));
  return {{"control_points",
           {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()}},
          {"relative_l2", r.relative_l2},
          {"node_error", r.node_error},
          {"spline_error", r.spline_error},
          {"gape_error", r.gape_error},
          {"false_gap", r.false_gap},
          {"largest_displacement_mm", r.largest_displacement},
          {"bytes", bytes},
          {"ratio_to_32_bit", raw / bytes}};
}

std::array<int, 4> four_counts(const std::vector<int>& counts) {
  if (counts.size() != 4) throw InputError("--control-points: expected four whole numbers U,V,W,T");
  double product = 1;
  for (int axis = 0; axis < 4; ++axis) {
    const int least = axis == 1 ? 8 : 4;
    if (counts[axis] < least)
      throw InputError(std::string("--control-points: ") + std::to_string(counts[axis]) +
                       " control points along " + "uvwt"[axis] + ": at least " + std::to_string(least));
    product *= counts[axis];
  }
  if (product > most_control_points)
    throw InputError("--control-points: " + shortest(product) + " in all; at most " +
                     shortest(most_control_points));
  return {counts[0], counts[1], counts[2], counts[3]};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits a discontinuous free-form deformation to a snapshot.", "cleft encode");
  std::string snapshot, out, parametrization = "fixed";
  std::vector<int> counts;
  bool json = false;
  EncodeOptions options;
  app.add_option("CASE.h5", snapshot, "snapshot")->required();
  app.add_option("--out", out, "field to write, case.dffd")->required();
  app.add_option("--control-points", counts,
                 "U,V,W,T: control points along each axis, V for both sides together (default 26,16,9,16)")
      ->delimiter(',');
  app.add_option("--parametrization", parametrization, "how the cut is followed")
      ->check(CLI::IsMember({"fixed"}))
      ->capture_default_str();
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    if (!counts.empty()) options.control_points = four_counts(counts);
    refuse_to_overwrite(out, {snapshot});
    const OutputFile probe(out);  // a bad name is told before the work
    Progress progress("encoding");
    const SnapshotReader reader(snapshot);
    const Field field = encode(reader, options, [&](const std::string& state) { progress(state); });
    write_field(out, field);
    print_figures(figures_of(field, reader.snapshot(), out), json);
  });
}
