// cleft advise: model no more than a scene needs.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/study.h"
#include "tradeoff/advice.h"

using namespace cleft;

namespace {

constexpr std::size_t most_models = 3;

/// Names that advice sets, which no study may vary.
std::vector<std::string> advised_names() {
  const Parameters p;
  return {row_of(p, p.mesh.element_size).name, row_of(p, p.mesh.grading).name, row_of(p, p.patch.length).name,
          row_of(p, p.patch.width).name, row_of(p, p.cut.frames).name};
}

/// The first, the middle and the last case: of a grid its corners.
std::vector<Parameters> representatives(const Study& study) {
  const std::vector<Case> cases = cases_of(study);
  std::vector<Parameters> chosen;
  const std::size_t count = std::min(most_models, cases.size());
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(cases[count == 1 ? 0 : i * (cases.size() - 1) / (count - 1)].parameters);
  return chosen;
}

double rounded(double x) {
  if (x == 0) return 0;
  const double digits = std::pow(10, 4 - std::ceil(std::log10(x)));
  return std::round(x * digits) / digits;
}

Json shown(const Expectation& e) {
  return {{"mesh", rounded(e.mesh)}, {"tip", rounded(e.tip)},       {"patch", rounded(e.patch)},
          {"code", rounded(e.code)}, {"detail", rounded(e.detail)}, {"total", rounded(e.total)}};
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("The cheapest settings that keep the whole chain, from mesh to code, within an error.",
                  "cleft advise");
  std::string path, out;
  Goals goals;
  bool json = false;
  app.add_option("STUDY.toml", path, "study file")->required();
  app.add_option("--error", goals.error,
                 "largest error of the opening, over the cut and over time, over the largest opening")
      ->required();
  app.add_option(
         "--frame-ms", goals.frame_ms,
         "most milliseconds for a replayed frame of 10,000 vertices in the patch; what moves least may be "
         "left alone for it")
      ->check(above(0));
  app.add_option("--mb", goals.megabytes, "most megabytes of all the study's fields")->check(above(0));
  app.add_option("--out", out, "study file to write, with what was chosen");
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    if (!(goals.error > 0 && goals.error < 1))
      throw InputError("--error " + shortest(goals.error) + ": must be above 0 and less than 1");
    const Study study = read_study(path);
    const std::vector<std::string> advised = advised_names();
    for (const Variation& v : study.vary)
      if (std::find(advised.begin(), advised.end(), v.name) != advised.end())
        throw InputError(path + ": [vary] " + v.name + ": is what would be chosen; remove it");
    if (!out.empty()) {
      refuse_to_overwrite(out, {path});
      const OutputFile probe(out);  // reports a bad name before the work
    }
    Progress progress("advising");
    const OutputFolder work(std::filesystem::temp_directory_path().string(), "cleft-advise");
    std::vector<CaseModel> models;
    for (const Parameters& parameters : representatives(study))
      models.emplace_back(parameters, work.path(), [&](const std::string& state) { progress(state); });
    goals.cases = static_cast<double>(cases_of(study).size());
    const Setting setting = advise(models, goals);
    const Expectation e = expectation(models, setting);
    const Parameters p = applied(setting, study.base.parameters);
    if (!out.empty()) {
      std::vector<std::pair<std::string, Value>> chosen = {
          {row_of(p, p.mesh.element_size).name, rounded(p.mesh.element_size)},
          {row_of(p, p.mesh.grading).name, p.mesh.grading},
          {row_of(p, p.patch.length).name, p.patch.length},
          {row_of(p, p.patch.width).name, p.patch.width}};
      if (study.base.parameters.cut.frames != p.cut.frames)
        chosen.emplace_back(row_of(p, p.cut.frames).name, text_of(p, p.cut.frames));
      write_text_file(out, with_settings(study, chosen, setting.tolerance));
    }
    double frame_ms = 0;
    for (const CaseModel& model : models) frame_ms = std::max(frame_ms, model.frame_ms(setting.detail));
    Json figures = {{"mesh.element_size_mm", rounded(p.mesh.element_size)},
                    {"mesh.grading", p.mesh.grading},
                    {"patch.length_mm", p.patch.length},
                    {"patch.width_mm", p.patch.width},
                    {"cut.frames", text_of(p, p.cut.frames)},
                    {"frames", e.frames},
                    {"control_points", models.front().control_points(setting.tolerance)},
                    {"tolerance", setting.tolerance},
                    {"detail_um", rounded(1e3 * setting.detail)},
                    {"expected_error", shown(e)},
                    {"dominates", e.dominating()},
                    {"nodes", std::round(e.nodes)},
                    {"processor_seconds_a_case", rounded(e.seconds)},
                    {"bytes_a_case", std::round(e.bytes)},
                    {"frame_ms", rounded(frame_ms)},
                    {"cases", goals.cases}};
    if (!out.empty()) figures["out"] = out;
    print_figures(figures, json);
  });
}
