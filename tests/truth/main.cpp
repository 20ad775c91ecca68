// How far replayed cuts are from simulated ones, over curvature, tilt, length and depth:
//   cleft-truth [LINES_OF_CASE]
// prints CSV: the opening of the truth, mm, and the errors of the opening and of the skin over the largest
// opening.
#include <cstdio>
#include <string>

#include "tests/truth/replay_error.h"
#include "tests/truth/truth_cases.h"

using namespace cleft;

int main(int argc, char** argv) {
  const std::string common = argc > 1 ? argv[1] : "";
  const TruthCases cases(common);
  const Field field = cases.canonical();
  std::printf("parameter,value,gape_mm,gape_error,skin_error\n");
  const auto row = [&](const std::string& parameter, const std::string& value, const std::string& more = "") {
    const SnapshotReader truth = cases.truth(parameter + " = " + value + more);
    const ReplayError e = replay_error(truth, field);
    std::printf("%s,%s,%.4f,%.4f,%.4f\n", parameter.c_str(), value.c_str(), e.gape, e.gape_error / e.gape,
                e.skin_error / e.gape);
    std::fflush(stdout);
  };
  row("cut.radius", "0");
  for (const char* radius : {"200", "100", "60", "40", "30", "20", "15"}) row("cut.radius", radius);
  for (const char* tilt : {"-45", "-30", "-15", "15", "30", "45"}) row("cut.tilt", tilt);
  for (const int length : {6, 10, 15, 20, 25, 40, 60, 90})
    row("cut.length", std::to_string(length), "\npatch.length = " + std::to_string(length + 30));
}
