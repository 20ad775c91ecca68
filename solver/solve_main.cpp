// cleft solve: a case file to a snapshot.
#include "base/command.h"
#include "base/output_file.h"
#include "params/study.h"
#include "solver/mpi_session.h"
#include "solver/solve.h"

using namespace cleft;

namespace {

Json figures_of(const SolveReport& r) {
  return {{"ranks", r.ranks},
          {"nodes", r.nodes},
          {"unknowns", r.unknowns},
          {"pairs", r.pairs},
          {"frames", r.frames},
          {"gape_mm", r.gape},
          {"largest_displacement_mm", r.largest_displacement},
          {"smallest_gap_mm", r.smallest_gap},
          {"residual_equilibrium", r.worst_equilibrium},
          {"residual_closure", r.worst_closure},
          {"seconds",
           {{"assemble", r.seconds_assemble}, {"factor", r.seconds_factor}, {"frames", r.seconds_frames}}}};
}

}  // namespace

int main(int argc, char** argv) {
  MpiSession mpi(argc, argv);
  const bool root = mpi.rank() == 0;
  if (!root) mpi.silence();  // one voice for all ranks

  CLI::App app("Solves a growing cut and writes its time series. Runs under mpirun too.", "cleft solve");
  std::string case_file, out;
  std::vector<std::string> assignments;
  bool json = false;
  app.add_option("CASE.toml", case_file, "case file")->required();
  app.add_option("--out", out, "snapshot to write, case.h5")->required();
  app.add_option("--set", assignments, "NAME=VALUE: overrides a parameter of the case (repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--json", json, "print the figures as JSON");
  app.footer([] { return parameter_help(); });

  const int code = run_command(app, argc, argv, [&] {
    refuse_to_overwrite(out, {case_file});
    const Case a_case = read_case(case_file, assignments);
    Progress progress("solving");
    const SolveReport report = solve_case(a_case.parameters, out, MPI_COMM_WORLD,
                                          [&](const std::string& state) { progress(state); });
    if (root) print_figures(figures_of(report), json);
  });
  if (code == 1) mpi.abort(code);
  return code;
}
