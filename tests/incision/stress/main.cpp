// cleft-stress-incision: random cuts through many meshes; prints what came of them.
#include <cstdio>

#include "base/command/command.h"
#include "base/error.h"
#include "tests/incision/stress/stress.h"
#include "tests/incision/stress/subjects.h"

namespace {

using namespace cleft;

struct Options {
  stress::Plan plan;
  std::string meshes, only;
  double minutes = 0;
  bool large = false, json = false;
};

void report(const std::string& name, const stress::Tally& t, bool json) {
  if (json) {
    print_figures(Json{{"mesh", name},
                       {"paths", t.paths},
                       {"steps", t.steps},
                       {"crossings", t.crossings},
                       {"refused", t.refused},
                       {"refused_impossible", t.due},
                       {"violations", t.violations},
                       {"poor_triangles", t.poor},
                       {"poor_triangles_squeezed", t.squeezed},
                       {"worst_quality_over_asked", t.worst_quality},
                       {"lips_off_by_1_percent", t.long_lips},
                       {"worst_lip_length_error", t.worst_lip_length},
                       {"blades_that_jump", t.jumping},
                       {"worst_area_change", t.worst_area}},
                  true);
  } else {
    std::printf(
        "%-34s %7ld paths %8ld steps %6ld crossings %5ld refused (%ld impossible) %4ld violations  quality "
        "%.2g (%ld poor, "
        "%ld squeezed)  "
        "lip %.2g "
        "(%ld, %ld jump)  area %.1g\n",
        name.c_str(), t.paths, t.steps, t.crossings, t.refused, t.due, t.violations, t.worst_quality, t.poor,
        t.squeezed, t.worst_lip_length, t.long_lips, t.jumping, t.worst_area);
  }
  std::fflush(stdout);
}

void run(const Options& o) {
  std::vector<stress::Subject> subjects = stress::generated_subjects(false);
  if (!o.meshes.empty())
    for (stress::Subject& subject : stress::subjects_of(o.meshes)) subjects.push_back(std::move(subject));
  if (o.large) subjects.push_back(stress::large_subject());
  if (!o.only.empty())
    std::erase_if(subjects, [&](const stress::Subject& s) { return s.name.find(o.only) == s.name.npos; });
  if (subjects.empty()) throw InputError("no mesh to cut: --only " + o.only + " names none");
  stress::Tally all;
  stress::Plan plan = o.plan;
  if (o.minutes > 0)
    plan.until = stress::Clock::now() + std::chrono::seconds(static_cast<long>(60 * o.minutes));
  plan.paths = std::max(1L, plan.paths / static_cast<long>(subjects.size()));
  for (const stress::Subject& subject : subjects) {
    plan.good = subject.good;
    const stress::Tally tally = stress::stress(subject.name, subject.mesh, plan);
    report(subject.name, tally, o.json);
    for (const std::string& line : tally.listed) std::printf("  %s\n", line.c_str());
    all.add(tally);
  }
  report("all", all, o.json);
  for (int i = 0; i < stress::path_kinds; ++i)
    std::printf("  %-12s %7ld paths %5ld refused %5ld poor\n",
                stress::name_of(static_cast<stress::PathKind>(i)).c_str(), all.paths_of[i], all.refused_of[i],
                all.poor_of[i]);
  for (const auto& [reason, count] : all.due_reasons)
    std::printf("  %5ld impossible: %s\n", count, reason.c_str());
  for (const auto& [reason, count] : all.reasons) std::printf("  %5ld refused: %s\n", count, reason.c_str());
  for (const std::string& violation : all.first_violations)
    std::printf("  violation: %s\n", violation.c_str());
  if (all.violations > 0) throw std::runtime_error(std::to_string(all.violations) + " violations");
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Cuts meshes along random paths and checks after every step what must hold.",
                  "cleft-stress-incision");
  Options o;
  app.add_option("--seed", o.plan.seed, "seed of the paths")->capture_default_str();
  app.add_option("--paths", o.plan.paths, "paths in all")->capture_default_str();
  app.add_option("--minutes", o.minutes, "stop after so long, with the report of what was cut; 0: never")
      ->capture_default_str();
  app.add_option("--meshes", o.meshes, "folder of .obj and .stl files, besides the generated ones");
  app.add_option("--only", o.only, "meshes whose name contains this");
  app.add_option("--path", o.plan.only,
                 "these paths alone, by their numbers, with those cut in the mesh at once");
  app.add_flag("--list", o.plan.list,
               "each path that was refused, or left poor triangles or lips of another length");
  app.add_flag("--large", o.large, "a mesh of a million triangles too");
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { run(o); });
}
