// How far replayed cuts are from simulated ones, over curvature, tilt, length and
// the distance of parallel cuts:
//   cleft-truth [LINES_OF_CASE [PARAMETER]]
// prints CSV: the opening of the truth, mm, and the errors of the opening and of the skin over the largest
// opening; by the canonical field, and by fields of three prestresses superposed as the tension turns.
#include <cstdio>
#include <string>

#include "tests/truth/truth_cases.h"
#include "tradeoff/replays/replay_error.h"

using namespace cleft;

namespace {

void print(const std::string& parameter, const std::string& value, const ReplayError& e) {
  std::printf("%s,%s,%.4f,%.4f,%.4f", parameter.c_str(), value.c_str(), e.gape, e.gape_error / e.gape,
              e.skin_error / e.gape);
}

/// One cut, in the patch of the canonical one but where that is too short.
void single_cuts(const std::string& common, const std::string& only) {
  const TruthCases cases(common);
  const Field field = cases.canonical();
  const PrestressFields fields = cases.prestresses();
  const auto row = [&](const std::string& parameter, const std::string& value, const std::string& more = "") {
    if (!only.empty() && parameter != only) return;
    const SnapshotReader truth = cases.truth(parameter + " = " + value + more);
    print(parameter, value, replay_error(truth, field));
    const ReplayError turned = replay_error(truth, fields);
    std::printf(",%.4f,%.4f\n", turned.gape_error / turned.gape, turned.skin_error / turned.gape);
    std::fflush(stdout);
  };
  row("cut.radius", "0");
  for (const char* radius : {"200", "100", "60", "40", "30", "20", "15"}) row("cut.radius", radius);
  for (const char* tilt : {"-45", "-30", "-15", "15", "30", "45"}) row("cut.tilt", tilt);
  for (const int length : {6, 10, 15, 20, 25, 40, 60, 90})
    row("cut.length", std::to_string(length), "\npatch.length = " + std::to_string(length + 30));
}

/// Two parallel cuts, in a patch so wide that both are as far from its sides as the canonical one.
void parallel_cuts(const std::string& common) {
  const TruthCases cases(common + "\npatch.width = 70\nmesh.grading = 1.15");
  const Field field = cases.canonical();
  for (const char* spacing : {"30", "20", "15", "12", "10", "8", "6", "4"}) {
    print("cut.spacing", spacing,
          parallel_error(cases.truth("cut.count = 2\ncut.spacing = " + std::string(spacing)), field));
    std::printf(",,\n");
    std::fflush(stdout);
  }
}

/// A cut that begins on the lip of another, in its middle. Where skin is pulled less along the first cut than
/// across, the branch's lips press on each other next to it.
void branches(const std::string& common) {
  const TruthCases cases(common + "\npatch.width = 70\nmesh.grading = 1.15");
  const PrestressFields fields = cases.prestresses();
  for (const auto& [name, lines] :
       {std::pair{"cut.branch", "cut.contact = true"},
        {"cut.branch, pulled alike", "skin.prestress_u = 0.02\nskin.prestress_v = 0.02"}})
    for (const std::string length : {"5", "10", "15", "20"}) {
      print(std::string("\"") + name + "\"", length,
            branch_error(cases.truth(std::string(lines) + "\ncut.branch = " + length), fields));
      std::printf(",,\n");
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string common = argc > 1 ? argv[1] : "", only = argc > 2 ? argv[2] : "";
  std::printf("parameter,value,gape_mm,gape_error,skin_error,turned_gape_error,turned_skin_error\n");
  if (only != "cut.spacing" && only != "cut.branch") single_cuts(common, only);
  if (only.empty() || only == "cut.spacing") parallel_cuts(common);
  if (only.empty() || only == "cut.branch") branches(common);
}
