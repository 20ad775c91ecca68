// cleft-faults: kills, full disks, failing writes and flipped bits under a study; prints what came of them.
#include <filesystem>

#include "base/command/command.h"
#include "tests/faults/disk.h"
#include "tests/faults/flips.h"
#include "tests/faults/kills.h"

using namespace cleft;

namespace {

struct Options {
  unsigned seed = 1;
  int kills = 500, flips = 10000, full_disks = 20, failing_writes = 20, ranks = 1;
  std::string place;
};

Json figures_of(const std::optional<faults::DiskReport>& report) {
  if (!report) return "not possible here";
  return {{"runs", report->runs}, {"that_failed", report->failed}};
}

void run(const Options& o) {
  std::filesystem::create_directories(o.place);
  const faults::StudyUnderFault study(std::filesystem::absolute(o.place).string(), o.ranks);
  std::mt19937 random(o.seed);
  Json figures = {{"seed", o.seed}};
  const faults::KillReport kills = kill_at_random(study, o.kills, random);
  figures["kills"] = {{"kills", kills.kills},
                      {"of_drivers", kills.drivers},
                      {"of_workers", kills.workers},
                      {"of_ranks", kills.ranks},
                      {"studies", kills.studies},
                      {"two_runs_at_once", kills.raced},
                      {"lost", 0},
                      {"wrong", 0}};
  const faults::FlipReport flips = flip_at_random(study, o.flips, random);
  figures["flips"] = {
      {"damages", flips.damages}, {"detected", flips.detected}, {"without_effect", flips.without_effect}};
  figures["full_disks"] = figures_of(fill_the_disk(study, o.full_disks, random));
  figures["failing_writes"] = figures_of(fail_writes(study, o.failing_writes, random));
  print_figures(figures, true);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Breaks what a study relies on, at random, and ends at the first promise that is not kept.",
                  "cleft-faults");
  Options o;
  app.add_option("PLACE", o.place, "a folder for what is made; it must not exist")
      ->required()
      ->check(nonexistent_path());
  app.add_option("--seed", o.seed, "of the random choices")->capture_default_str();
  app.add_option("--kills", o.kills, "kill -9 of drivers, workers and ranks")->capture_default_str();
  app.add_option("--flips", o.flips, "bits flipped and files cut")->capture_default_str();
  app.add_option("--full-disks", o.full_disks, "runs on a small file system (root)")->capture_default_str();
  app.add_option("--failing-writes", o.failing_writes, "runs with writes that fail now and then")
      ->capture_default_str();
  app.add_option("--ranks", o.ranks, "MPI ranks of each solve")->capture_default_str();
  return run_command(app, argc, argv, [&] { run(o); });
}
