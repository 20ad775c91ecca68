// cleft advise: model no more than a scene needs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "params/consistency.h"
#include "params/parameters/table.h"
#include "params/sensitivities.h"
#include "params/study.h"
#include "tradeoff/advice.h"

using namespace cleft;

namespace {

constexpr std::size_t most_models = 3;

/// Names that advice sets, which no study may vary.
std::vector<std::string> advised_names() {
  const Parameters p;
  return {row_of(p, p.mesh.element_size).name, row_of(p, p.mesh.grading).name,
          row_of(p, p.patch.length).name,      row_of(p, p.patch.width).name,
          row_of(p, p.cut.frames).name,        row_of(p, p.mesh.elements).name};
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
  return {{"mesh", rounded(e.mesh)},  {"tip", rounded(e.tip)},       {"patch", rounded(e.patch)},
          {"code", rounded(e.code)},  {"detail", rounded(e.detail)}, {"model", rounded(e.model)},
          {"total", rounded(e.total)}};
}

/// Why the model cannot be chosen; empty if it can.
std::string obstacle_to_choice(const Study& study, const std::string& path) {
  const Parameters p;
  const std::string name = row_of(p, p.model).name;
  if (std::any_of(study.vary.begin(), study.vary.end(), [&](const Variation& v) { return v.name == name; }))
    return path + " varies " + name;
  if (std::find(study.given.begin(), study.given.end(), name) != study.given.end())
    return path + " sets " + name + " = \"" + text_of(study.base.parameters, study.base.parameters.model) +
           "\"";
  for (Case one : cases_of(study)) {
    one.parameters.model = Model::finite;
    try {
      check_consistency(one.parameters, study.name);
      check_sensitivities(one.sensitivities, one.parameters, study.name + ": sensitivities");
    } catch (const InputError& e) {
      return e.what();
    }
  }
  return "";
}

/// What is known of the models for some cases of a study.
struct Comparison {
  std::vector<ModelKnowledge> knowledge;
  std::string because;                     ///< why the model could not be chosen; empty if it can be
  std::string unknown;                     ///< why the small model's error is not known; empty if it is
  double small_rise = 0, finite_rise = 0;  ///< mm, of the highest lip
};

Comparison compared(const std::vector<Parameters>& cases, const std::string& obstacle,
                    const std::string& work, const std::function<void(const std::string&)>& progress) {
  Comparison all;
  all.because = obstacle;
  for (const Parameters& parameters : cases) {
    all.knowledge.emplace_back();
    try {
      const ModelError error = model_error(parameters, work, progress);
      all.small_rise = std::max(all.small_rise, error.small_rise);
      all.finite_rise = std::max(all.finite_rise, error.finite_rise);
      all.knowledge.back().error = error;
    } catch (const std::runtime_error& e) {
      if (parameters.model == Model::finite) throw;
      all.unknown = e.what();
    }
  }
  if (all.because.empty()) all.because = all.unknown;
  for (ModelKnowledge& one : all.knowledge) one.choose = all.because.empty();
  return all;
}

/// Why a model was chosen: what small strains make wrong, and what the other model would cost.
std::string reason_of_choice(const std::vector<CaseModel>& models, Setting chosen, Goals goals) {
  const auto text = [](double x) { return shortest(rounded(x)); };
  goals.model = chosen.model == Model::small ? Model::finite : Model::small;
  chosen.model = Model::small;
  std::string reason = "small strains are off by " + text(expectation(models, chosen).model) + "; ";
  reason += goals.model == Model::small ? "within the error they " : "finite ones ";
  try {
    const Setting other = advise(models, goals);
    return reason + "would take " + text(expectation(models, other).seconds) + " processor seconds a case";
  } catch (const InputError&) {
    return reason + "cannot be had";
  }
}

/// Where the model is the study's own, its error is not among those that were asked to be small.
void warn_of_model(const Comparison& models, const Expectation& e, double asked) {
  const std::string prefix = "cleft advise: warning: ";
  if (e.model_counts) return;
  if (!models.unknown.empty())
    std::cerr << prefix << "how far small strains are off could not be measured: " << models.unknown << "\n";
  else if (e.model > 0 && e.total + e.model > asked)
    std::cerr << prefix << "small strains are off by another " << shortest(rounded(e.model))
              << " of the opening, which is not in the error of " << shortest(asked)
              << "; the model is not chosen: " << models.because << "\n";
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
    if (!study.base.body.empty())
      throw InputError(path + ": [body]: advice is for the mesh and the patch of a case; remove [body]");
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
    const auto show = [&](const std::string& state) { progress(state); };
    const std::vector<Parameters> cases = representatives(study);
    for (const Parameters& parameters : cases) check_advisable(parameters);
    const Comparison compared_models = compared(cases, obstacle_to_choice(study, path), work.path(), show);
    std::vector<CaseModel> models;
    for (std::size_t i = 0; i < cases.size(); ++i)
      models.emplace_back(cases[i], work.path(), show, compared_models.knowledge[i],
                          goals.error <= most_of_quadratic);
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
      if (study.base.parameters.mesh.elements != p.mesh.elements)
        chosen.emplace_back(row_of(p, p.mesh.elements).name, text_of(p, p.mesh.elements));
      if (study.base.parameters.model != p.model)
        chosen.emplace_back(row_of(p, p.model).name, text_of(p, p.model));
      write_text_file(out, with_settings(study, chosen, setting.tolerance));
    }
    const std::string because =
        e.model_counts ? reason_of_choice(models, setting, goals) : compared_models.because;
    double frame_ms = 0;
    for (const CaseModel& model : models) frame_ms = std::max(frame_ms, model.frame_ms(setting.detail));
    warn_of_model(compared_models, e, goals.error);
    Json figures = {{"model", text_of(p, p.model)},
                    {"model_because", because},
                    {"mesh.element_size_mm", rounded(p.mesh.element_size)},
                    {"mesh.grading", p.mesh.grading},
                    {"mesh.elements", text_of(p, p.mesh.elements)},
                    {"patch.length_mm", p.patch.length},
                    {"patch.width_mm", p.patch.width},
                    {"cut.frames", text_of(p, p.cut.frames)},
                    {"frames", e.frames},
                    {"control_points", models.front().control_points(setting)},
                    {"tolerance", setting.tolerance},
                    {"detail_um", rounded(1e3 * setting.detail)},
                    {"expected_error", shown(e)},
                    {"dominates", e.dominating()},
                    {"nodes", std::round(e.nodes)},
                    {"processor_seconds_a_case", rounded(e.seconds)},
                    {"bytes_a_case", std::round(e.bytes)},
                    {"frame_ms", rounded(frame_ms)},
                    {"cases", goals.cases}};
    if (compared_models.small_rise > 0)
      figures["lips_rise_mm"] = {{"small", rounded(compared_models.small_rise)},
                                 {"finite", rounded(compared_models.finite_rise)}};
    if (!out.empty()) figures["out"] = out;
    print_figures(figures, json);
  });
}
