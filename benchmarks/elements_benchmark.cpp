// A frame of a patch, its whole cut open, in elements of several kinds: what it costs and how far it opens.
//   cleft-benchmark-elements KIND ALONG DOWN GROWTH TOWARDS END BOTTOM [PARAMETER=VALUE...]
// KIND: linear, quadratic, quarter or enriched; solver: the linear ones by `cleft solve`'s own code, whose
// settings are PARAMETER=VALUE then. ALONG, DOWN: elements between the closed nodes at the ends, and down to
// those at the bottom. GROWTH: of elements away from the cut. TOWARDS: of elements within it, from the
// fronts. END, BOTTOM: parts of the outermost elements by which the cut ends inside its closed nodes. Prints
// JSON: unknowns, processor seconds, and the opening by millimetres along the skin.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>

#include "base/stopwatch.h"
#include "benchmarks/elements/open_patch.h"
#include "params/parameters/table.h"
#include "solver/companion.h"
#include "solver/mpi_session.h"

namespace {

using namespace cleft;
using namespace cleft::elements;

const std::map<std::string, Kind> kinds = {{"linear", Kind::linear},
                                           {"quadratic", Kind::quadratic},
                                           {"quarter", Kind::quarter_points},
                                           {"enriched", Kind::enriched}};

Parameters parameters_of(int argc, char** argv) {
  Parameters p;
  for (int i = 8; i < argc; ++i) {
    const std::string setting = argv[i];
    const auto equal = setting.find('=');
    std::get<0>(find_parameter(setting.substr(0, equal), "parameter").access)(p) =
        std::atof(setting.substr(equal + 1).c_str());
  }
  return p;
}

void print_list(const char* name, const std::vector<double>& list) {
  std::printf(", \"%s\": [", name);
  for (std::size_t i = 0; i < list.size(); ++i) std::printf("%s%.9g", i > 0 ? ", " : "", list[i]);
  std::printf("]");
}

int run(int argc, char** argv) {
  if (argc < 8) {
    std::fprintf(stderr,
                 "cleft-benchmark-elements KIND ALONG DOWN GROWTH TOWARDS END BOTTOM [PARAMETER=VALUE...]\n");
    return 2;
  }
  const Parameters p = parameters_of(argc, argv);
  if (std::string(argv[1]) == "solver") {
    const double begin = processor_seconds(), gape = gape_of(p, MPI_COMM_WORLD);
    std::printf("{\"gape\": %.9g, \"seconds\": %.4g}\n", gape, processor_seconds() - begin);
    return 0;
  }
  const auto kind = kinds.find(argv[1]);
  if (kind == kinds.end()) {
    std::fprintf(stderr, "KIND = %s: give linear, quadratic, quarter, enriched or solver\n", argv[1]);
    return 2;
  }
  Division division{std::atoi(argv[2]), std::atoi(argv[3])};
  division.growth = std::atof(argv[4]), division.towards_fronts = std::atof(argv[5]);
  division.end = std::atof(argv[6]), division.bottom = std::atof(argv[7]);
  const Opened opened = open_patch(p, cut_lines(p, division), kind->second);
  std::printf("{\"unknowns\": %d, \"assembly\": %.4g, \"solution\": %.4g", opened.unknowns, opened.assembly,
              opened.solution);
  print_list("along", opened.along);
  print_list("opening", opened.opening);
  std::printf("}\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const MpiSession mpi(argc, argv);
  return run(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "cleft-benchmark-elements: error: %s\n", error.what());
  return 1;
}
