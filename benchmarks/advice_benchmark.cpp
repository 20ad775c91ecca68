// What advice is worth: cases of random tissue, skin and cut, the error that the advised setting truly has,
// and what it costs beside the cheapest setting that truly keeps the error.
//   cleft-benchmark-advice [SETS [SEED [ERROR [FIRST]]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <vector>

#include "base/output_folder.h"
#include "base/quantiles.h"
#include "params/consistency.h"
#include "tests/support/drawn_case.h"
#include "tradeoff/advice.h"
#include "tradeoff/chain.h"

using namespace cleft;

namespace {

struct Outcome {
  Setting setting;
  double error, seconds;
};

constexpr double most_nodes = 150000;  // some 10 GB

/// A much finer mesh, 3 to 6 times, in a patch twice as wide. What is left of the mesh's error there is that
/// part of it: less of it hides in the reference, the finer it is.
Parameters reference(const Parameters& parameters, const Setting& finest) {
  Parameters p;
  for (const int finer : {6, 5, 4, 3}) {
    p = applied({.element_size = finest.element_size / finer, .margin = 2 * finest.margin}, parameters);
    if (estimated_nodes(p) <= most_nodes) break;
  }
  return p;
}

/// A case's reference, and settings beside it.
class Truth {
 public:
  Truth(const Parameters& parameters, const Setting& finest, const std::string& work)
      : parameters_(parameters),
        work_(work),
        opening_(Chain(reference(parameters, finest), work).opening()) {}

  std::vector<Outcome> outcomes(Setting setting, const std::vector<double>& tolerances) const {
    const Chain chain(applied(setting, parameters_), work_);
    std::vector<Outcome> all;
    for (const double tolerance : tolerances) {
      setting.tolerance = tolerance;
      const Chain::Encoded encoded = chain.encoded(tolerance);
      all.push_back(
          {setting, opening_error(encoded.field, opening_), chain.solve_seconds() + encoded.seconds});
    }
    return all;
  }

  /// What each costs: the median of turns in which all are run one after the other, since even the time of
  /// the processor goes up and down by half with what its neighbours do.
  void time(std::vector<Outcome>& settings) const {
    std::vector<std::vector<double>> seconds(settings.size());
    for (int turn = 0; turn < 5; ++turn)
      for (std::size_t i = 0; i < settings.size(); ++i)
        seconds[i].push_back(outcomes(settings[i].setting, {settings[i].setting.tolerance}).front().seconds);
    for (std::size_t i = 0; i < settings.size(); ++i) settings[i].seconds = median(seconds[i]);
  }

 private:
  Parameters parameters_;
  std::string work_;
  Opening opening_;
};

}  // namespace

int main(int argc, char** argv) {
  const int sets = argc > 1 ? std::atoi(argv[1]) : 10;
  std::mt19937 random(static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 1));
  const double error = argc > 3 ? std::atof(argv[3]) : 0.1;
  const int first = argc > 4 ? std::atoi(argv[4]) : 0;
  const OutputFolder work(std::filesystem::temp_directory_path().string(), "cleft-benchmark-advice");
  int within = 0, within_twice = 0, cheap = 0;
  std::printf("%5s %8s %8s %9s %8s %8s %8s %9s %8s %9s   %s\n", "set", "element", "margin", "tolerance",
              "expected", "true", "seconds", "cheapest", "ratio", "tried", "which is the cheapest");
  for (int i = 0; i < sets; ++i) {
    const Parameters p = drawn_case(random);
    if (i < first) continue;
    std::vector<CaseModel> models;
    models.emplace_back(p, work.path(), [](const std::string&) {});
    const Setting chosen = advise(models, {.error = error});
    const double expected = expectation(models, chosen).total;
    const Truth truth(p, chosen, work.path());
    std::vector<Outcome> rivals;  // that keep the error
    // Every setting of a lattice whose mesh is smaller.
    const auto nodes = [&](const Setting& s) { return estimated_nodes(applied(s, p)); };
    int tried = 0;
    for (const double elements : {8, 12, 16, 20, 24, 32, 48})
      for (const double margin : {0.5, 1., 2., 3., 4., 6.}) {
        const Setting other{.element_size = p.cut.length / elements, .margin = margin * p.cut.length};
        if (nodes(other) >= nodes(chosen)) continue;
        ++tried;
        for (const Outcome& o : truth.outcomes(other, {0.1, 0.02}))
          if (o.error <= error) rivals.push_back(o);
      }
    const auto cheaper = [](const Outcome& a, const Outcome& b) { return a.seconds < b.seconds; };
    std::sort(rivals.begin(), rivals.end(), cheaper);
    if (rivals.size() > 3) rivals.resize(3);
    rivals.push_back(truth.outcomes(chosen, {chosen.tolerance}).front());
    truth.time(rivals);
    const Outcome outcome = rivals.back(),
                  cheapest = *std::min_element(rivals.begin(), rivals.end(), cheaper);
    within += outcome.error <= error, within_twice += outcome.error <= 2 * error;
    cheap += outcome.seconds <= 2 * cheapest.seconds;
    std::printf("%5d %8.3f %8.1f %9g %8.4f %8.4f %8.2f %9.2f %8.2f %9d   %.3f %.1f %g: %.4f\n", i,
                chosen.element_size, chosen.margin, chosen.tolerance, expected, outcome.error,
                outcome.seconds, cheapest.seconds, outcome.seconds / cheapest.seconds, tried,
                cheapest.setting.element_size, cheapest.setting.margin, cheapest.setting.tolerance,
                cheapest.error);
    std::fflush(stdout);
  }
  std::printf("of %d: within the error %d, within twice %d; at most twice the cheapest %d\n", sets - first,
              within, within_twice, cheap);
}
