// cleft-stress-wound: random cuts through many meshes, opened; prints what that does to the skin around them.
#include <cstdio>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "tests/wound/stress/opening_stress.h"

namespace {

using namespace cleft;

struct Options {
  std::string field, meshes, only;
  stress::OpeningPlan plan;
  long cuts = 1000;
  std::vector<double> direction, prestresses;
};

void report(const std::string& name, const stress::OpeningTally& t) {
  std::printf("%-34s %6ld cuts %5ld refused %5ld of %ld groups unsound, slowest %.2g s: %s\n", name.c_str(),
              t.cuts, t.refused, t.unsound, t.groups, t.slowest, text_of(t.sum).c_str());
  for (const std::string& line : t.listed) std::printf("  %s\n", line.c_str());
  std::fflush(stdout);
}

stress::FieldsOfGroup fields_of(const Options& o) {
  if (o.direction.empty() && format_of(o.field) == "cleft-study" &&
      Family::describes(PublishedStudy(o.field).varying())) {
    const auto family = std::make_shared<const Family>(o.field);
    return [family] { return CutFields(std::make_shared<const FamilyFields>(family), std::nullopt); };
  }
  const CutFields fields = read_cut_fields(o.field, skin_tension(o.direction, o.prestresses));
  return [fields] { return CutFields(fields); };
}

void run(const Options& o) {
  const stress::FieldsOfGroup fields = fields_of(o);
  const stress::FieldLimits limits(fields().shape());
  if (!fields().following_shape())
    std::printf("the field moves by at most %.4g mm, its strain is at most %.3g\n", limits.displacement,
                limits.strain);
  std::vector<stress::Subject> subjects = stress::generated_subjects(true);
  if (!o.meshes.empty())
    for (stress::Subject& subject : stress::subjects_of(o.meshes)) subjects.push_back(std::move(subject));
  std::erase_if(subjects, [&](const auto& s) { return s.name.find(o.only) == s.name.npos; });
  if (subjects.empty()) throw InputError("no mesh to cut: --only " + o.only + " names none");
  stress::OpeningPlan plan = o.plan;
  plan.cuts = std::max(1L, o.cuts / static_cast<long>(subjects.size()));
  stress::OpeningTally all;
  for (const stress::Subject& subject : subjects) {
    const stress::OpeningTally tally = stress::open_random_cuts(subject, fields, limits, plan);
    report(subject.name, tally);
    all.add(tally);
  }
  report("all", all);
  for (int i = 0; i < stress::path_kinds; ++i)
    std::printf("  last cut %-12s %6ld groups %5ld unsound\n",
                stress::name_of(static_cast<stress::PathKind>(i)).c_str(), all.of[i], all.unsound_of[i]);
  if (all.unsound > 0)
    throw std::runtime_error(std::to_string(all.unsound) + " groups of cuts are unsound when they are open");
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Cuts meshes along random paths, opens the cuts, and counts what that does to the skin.",
                  "cleft-stress-wound");
  Options o;
  app.add_option("--field", o.field, "field file, or study.dffd of three prestresses or of a family")
      ->required();
  app.add_option("--tension", o.direction, "direction of the skin's tension, three numbers");
  app.add_option("--prestress", o.prestresses, "the two tensions, MPa");
  app.add_option("--seed", o.plan.seed, "seed of the paths")->capture_default_str();
  app.add_option("--cuts", o.cuts, "cuts in all")->capture_default_str();
  app.add_option("--positions", o.plan.positions, "positions of the blade")->capture_default_str();
  app.add_option("--at-once", o.plan.cuts_at_once, "cuts in the mesh at most")->capture_default_str();
  app.add_option("--meshes", o.meshes, "folder of .obj and .stl files, besides the generated ones");
  app.add_option("--only", o.only, "meshes whose name contains this");
  app.add_option("--cut", o.plan.only, "these cuts alone, by their numbers, with those in the mesh at once");
  app.add_flag("--crossing", o.plan.crossing,
               "pairs of cuts, the second across the first, in meshes that are in mm as they are");
  app.add_flag("--list", o.plan.list, "each group of cuts that is unsound, or takes more than 10 s");
  return run_command(app, argc, argv, [&] { run(o); });
}
