// solve_with_rule CASE.toml OUT.h5 [BODY.h5]: cleft solve with the wedge rule of CalculiX, to compare with
// it.
#include <cstdio>

#include "params/study.h"
#include "solver/body_mesh.h"
#include "solver/mpi_session.h"
#include "solver/solve.h"

int main(int argc, char** argv) {
  using namespace cleft;
  const MpiSession mpi(argc, argv);
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: solve_with_rule CASE.toml OUT.h5 [BODY.h5]\n");
    return 2;
  }
  SolveOptions options;
  options.discretization.rule = WedgeRule::centroid_by_two;
  Parameters parameters = read_case(argv[1], {}).parameters;
  if (argc == 4) {
    options.body = std::make_shared<const Body>(read_body(argv[3])), options.estimate = false;
    parameters = parameters_of(*options.body, parameters);
  }
  const auto reports = solve_cases({{parameters, argv[2]}}, options, MPI_COMM_WORLD, [](const auto&) {});
  if (!reports[0].failure.empty()) std::fprintf(stderr, "%s\n", reports[0].failure.c_str());
  return reports[0].failure.empty() ? 0 : 1;
}
