// How far cases of random tissue, skin and cut, with all settings of mesh, patch and encoder at their
// defaults, are from their converged answer, and the same with elements twice as long:
//   cleft-truth-defaults [SETS [SEED]]
// prints CSV: the largest error of the opening, over the cut and over time, over the largest opening; seconds
// of processors to solve and encode; bytes of the field. The error stands there twice, for in every mesh the
// node next to a closed one opens too far, by 6 % in a sheet in closed form, however small its elements are:
//   error       at all nodes of the converged mesh but those
//   error_ends  from there to the ends, where the opening closes as the square root of the distance
#include <algorithm>
#include <cmath>
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

/// Largest differences over the largest opening.
struct Errors {
  double inside = 0, ends = 0;
};

constexpr std::size_t least_open = 3;  // nodes of the converged mesh, in the frames that count

Errors errors_of(const Field& field, const Opening& truth) {
  Errors most;
  for (std::size_t j = 0; j < truth.times().size(); ++j) {
    const double t = truth.times()[j];
    const auto difference = [&](double s, const Vec3& exact) {
      return norm(opening(field, s, t) - exact) / truth.largest();
    };
    const std::vector<double>& along = truth.along();
    std::size_t closed = 1;  // the first node at the tip or beyond
    while (closed < along.size() && along[closed] < t) ++closed;
    if (closed < least_open + 1) continue;
    for (std::size_t i = 2; i + 2 <= closed; ++i)
      most.inside = std::max(most.inside, difference(along[i], truth.node(j, i)));
    for (const std::size_t i : {std::size_t{2}, closed - 2}) {
      const double s = along[i], r = std::min(s, t - s);
      const Vec3 shape = (1 / std::sqrt(s * (t - s))) * truth.node(j, i);
      // Over the root the opening is the same from here to the end.
      for (const double part : {0.03, 0.1, 0.2, 0.4, 0.6, 0.8}) {
        const double near = i == 2 ? part * r : t - part * r;
        most.ends = std::max(most.ends, difference(near, std::sqrt(near * (t - near)) * shape));
      }
    }
  }
  return most;
}

}  // namespace

int main(int argc, char** argv) {
  const int sets = argc > 1 ? std::atoi(argv[1]) : 20;
  std::mt19937 random(static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 1));
  const OutputFolder work(std::filesystem::temp_directory_path().string(), "cleft-truth-defaults");
  const EncodeSettings encode;
  std::printf("set,length_mm,depth_mm,skin_over_tissue_mm,opening_mm,error,error_ends,nodes,seconds,bytes,");
  std::printf("coarse_error,coarse_error_ends,coarse_seconds\n");
  for (int i = -1; i < sets; ++i) {
    const Parameters p = i < 0 ? Parameters() : drawn_case(random);
    const Opening truth = Chain(converged(p), work.path()).opening();
    const auto show = [&](Parameters shown, bool fine) {
      const Chain chain(shown, work.path());
      const Chain::Encoded encoded = chain.encoded(encode.tolerance);
      const Errors error = errors_of(encoded.field, truth);
      const double seconds = chain.solve_seconds() + encoded.seconds;
      if (fine)
        std::printf("%s,%.0f,%.1f,%.1f,%.2f,%.3f,%.3f,%.0f,%.2f,%.0f",
                    i < 0 ? "default" : std::to_string(i).c_str(), p.cut.length, p.cut.depth,
                    p.skin.thickness * p.skin.young_modulus / p.tissue.young_modulus, truth.largest(),
                    error.inside, error.ends, chain.nodes(), seconds, encoded.bytes);
      else
        std::printf(",%.3f,%.3f,%.2f\n", error.inside, error.ends, seconds);
    };
    show(p, true);
    Parameters coarse = p;
    coarse.mesh.element_size *= 2;
    show(coarse, false);
    std::fflush(stdout);
  }
}
