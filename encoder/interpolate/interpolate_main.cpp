// cleft interpolate: the field of a case that was never simulated.
#include <filesystem>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "encoder/interpolate/compact.h"
#include "encoder/interpolate/residual_between.h"
#include "encoder/interpolate/study_interpolator.h"

using namespace cleft;

namespace {

Json figures_of(const Field& field, const StudyInterpolator& study, const std::string& out) {
  const Interpolation& made = *field.interpolation;
  Json features = Json::array();
  for (const std::string& name : study.features().names()) features.push_back(name);
  return {{"estimated_error", made.estimated_error},
          {"error_at_nodes", field.report.node_error},
          {"interpolation_error", made.interpolation_error},
          {"outside", made.outside},
          {"method", made.method},
          {"features", features},
          {"prestress_superposed", study.features().loading() == Loading::superposed},
          {"cases", study.cases().size()},
          {"derivatives", study.cases().derivatives().size()},
          {"largest_displacement_mm", field.report.largest_displacement},
          {"parametrization", field.parametrization().name()},
          {"control_points",
           {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()}},
          {"quantum_mm", field.quantum},
          {"bytes", std::filesystem::file_size(out)}};
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Makes the field of a case that was never simulated from those of a study.",
                  "cleft interpolate");
  std::string study, out;
  std::vector<std::string> assignments;
  bool json = false;
  app.add_option("DIR", study, "study folder, or its study.dffd")->required();
  app.add_option("--set", assignments,
                 "NAME=VALUE[,NAME=VALUE...]: every parameter in which the study's cases differ")
      ->delimiter(',')
      ->required();
  app.add_option("--out", out, "field to write, new.dffd")->required();
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    refuse_to_overwrite(out, {study});
    const OutputFile probe(out);  // reports a bad name before the work
    const CaseParameters values = numbers_by_name(assignments, "--set");
    Progress progress("interpolating");
    progress("reading the study");
    if (std::vector<std::string> damaged; std::filesystem::is_directory(study)) {
      published_study_cases(study, nullptr, &damaged);
      if (!damaged.empty())
        std::cerr << "cleft interpolate: warning: " << note_of_damaged(study, damaged) << "\n";
    }
    const StudyInterpolator interpolator(study);
    Encoded between = between_with_nodes(interpolator, study, values);
    between.field = compact_interpolated(between.field);
    const Field& field = between.field;
    write_field(out, between);
    if (const double outside = field.interpolation->outside; outside > 0)
      std::cerr << "cleft interpolate: warning: these parameters lie outside the study, by "
                << shortest(std::round(1000 * outside) / 1000)
                << " of its spread; the estimated error is a guess there\n";
    print_figures(figures_of(read_field(out), interpolator, out), json);
  });
}
