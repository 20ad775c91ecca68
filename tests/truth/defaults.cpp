// How far cases of random tissue, skin and cut, with all settings of mesh, patch and encoder at their
// defaults, are from their converged answer, and the same with elements twice as long:
//   cleft-truth-defaults [SETS [SEED]]
// prints CSV: the largest error of the opening, over the cut and over time, over the largest opening; seconds
// of processors to solve and encode; bytes of the field.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "base/output_folder.h"
#include "params/study.h"
#include "tests/support/drawn_case.h"
#include "tradeoff/chain.h"

using namespace cleft;

namespace {

/// In a patch that ends four lengths of the cut away, and at least 80 mm, with elements of a third of the
/// size.
Parameters converged(Parameters p) {
  const double margin = std::max(80., 4 * p.cut.length);
  p.patch.length = p.cut.length + 2 * margin, p.patch.width = 2 * margin;
  p.mesh.element_size /= 3;
  return p;
}

}  // namespace

int main(int argc, char** argv) {
  const int sets = argc > 1 ? std::atoi(argv[1]) : 20;
  std::mt19937 random(static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 1));
  const OutputFolder work(std::filesystem::temp_directory_path().string(), "cleft-truth-defaults");
  const EncodeSettings encode;
  std::printf("set,length_mm,depth_mm,opening_mm,error,nodes,seconds,bytes,coarse_error,coarse_seconds\n");
  for (int i = -1; i < sets; ++i) {
    const Parameters p = i < 0 ? Parameters() : drawn_case(random);
    const Opening truth = Chain(converged(p), work.path()).opening();
    const auto show = [&](Parameters shown, bool fine) {
      const Chain chain(shown, work.path());
      const Chain::Encoded encoded = chain.encoded(encode.tolerance);
      const double error = opening_error(encoded.field, truth),
                   seconds = chain.solve_seconds() + encoded.seconds;
      if (fine)
        std::printf("%s,%.1f,%.1f,%.3f,%.4f,%.0f,%.2f,%.0f", i < 0 ? "default" : std::to_string(i).c_str(),
                    p.cut.length, p.cut.depth, truth.largest(), error, chain.nodes(), seconds, encoded.bytes);
      else
        std::printf(",%.4f,%.2f\n", error, seconds);
    };
    show(p, true);
    Parameters coarse = p;
    coarse.mesh.element_size *= 2;
    show(coarse, false);
    std::fflush(stdout);
  }
}
