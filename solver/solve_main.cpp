// cleft solve: case files to snapshots.
#include <deal.II/base/config.h>
#include <dmumps_c.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "base/output_file.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/study.h"
#include "solver/body/skin_turn.h"
#include "solver/body_mesh.h"
#include "solver/mpi_session.h"
#include "solver/snapshot/snapshot.h"
#include "solver/solve.h"
#include "solver/unsolved.h"

using namespace cleft;

namespace {

/// Those of the case files, which are solved together.
void take_sensitivities(const Case& one, bool first, const std::string& file, SolveOptions& options) {
  if (first) options.sensitivities = one.sensitivities;
  if (options.sensitivities != one.sensitivities)
    throw InputError(file +
                     ": sensitivities are not those of the first case file; solve the cases one by one, or "
                     "give --sensitivities for all");
}

/// The body of the case files, which is one for all of them; `taken`: the digest of the first one's.
void take_body(const Case& one, bool first, const std::string& file, std::string& taken,
               SolveOptions& options) {
  if (first) taken = one.body_digest;
  if (first && !one.body.empty()) options.body = std::make_shared<const Body>(read_body(one.body));
  if (one.body_digest != taken)
    throw InputError(file + ": [body] is not that of the first case file; solve the cases one by one");
}

std::string number_of_trilinos() {
  return std::to_string(DEAL_II_TRILINOS_VERSION_MAJOR) + "." +
         std::to_string(DEAL_II_TRILINOS_VERSION_MINOR);
}

std::string version_of_mpi() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string version(text);
  return version.substr(0, version.find_first_of(",\n"));
}

/// Of what computes.
Json versions() {
  return {{"cleft", producer()},
          {"deal.II", DEAL_II_PACKAGE_VERSION},
          {"Trilinos", number_of_trilinos()},
          {"MUMPS", MUMPS_VERSION},
          {"HDF5", h5::version()},
          {"MPI", version_of_mpi()}};
}

/// Of each frame the residuals of Newton's method, the last one included, and the iterations of its steps.
Json newton_of(const std::vector<NewtonFrame>& frames) {
  Json list = Json::array();
  for (const NewtonFrame& frame : frames) {
    Json residuals = Json::array(), iterations = Json::array();
    for (const NewtonStep& step : frame.steps)
      residuals.push_back(step.residual), iterations.push_back(step.iterations);
    residuals.push_back(frame.residual);
    list.push_back({{"frame", frame.frame},
                    {"residuals", residuals},
                    {"iterations", iterations},
                    {"load_steps", frame.load_steps}});
  }
  return list;
}

Json figures_of(const SolveReport& r) {
  Json seconds, memory;
  for (const Phase& phase : r.phases) {
    seconds[phase.name] = phase.seconds;
    memory[phase.name] = std::round(phase.peak_memory / 1e6);
  }
  Json figures = {{"out", r.out},
                  {"method", r.method},
                  {"reason", r.reason},
                  {"ranks", r.ranks},
                  {"nodes", r.nodes},
                  {"unknowns", r.unknowns},
                  {"constraints", r.constraints},
                  {"pairs", r.pairs},
                  {"frames", r.frames},
                  {"cases_sharing", r.cases_sharing},
                  {"gape_mm", r.gape},
                  {"largest_displacement_mm", r.largest_displacement},
                  {"smallest_gap_mm", r.smallest_gap},
                  {"residual_equilibrium", r.worst_equilibrium},
                  {"residual_closure", r.worst_closure}};
  if (const auto& expected = r.estimate.expected)
    figures["expected_gape_error"] = {{"mesh", expected->mesh}, {"patch", expected->patch}};
  if (!r.estimate.obstacle.empty()) figures["no_expected_gape_error"] = r.estimate.obstacle;
  figures["versions"] = versions();
  if (!r.iterations.empty()) figures["iterations"] = r.iterations;
  if (!r.newton.empty()) figures["newton"] = newton_of(r.newton);
  figures["expected_peak_memory_mb"] = std::round(r.expected_peak / 1e6);
  if (!r.phases.empty()) figures["seconds"] = seconds, figures["peak_memory_mb"] = memory;
  return figures;
}

/// Of the opening, beyond which the command warns.
constexpr double much = 0.1;
/// mm, by which lips overlap, beyond which it warns.
constexpr double much_overlap = 0.05;

void warn_of(const SolveReport& r) {
  if (r.smallest_gap < -much_overlap)
    std::cerr << "cleft solve: warning: " << r.out << ": lips pass through each other, by up to "
              << shortest(std::round(-1000 * r.smallest_gap) / 1000)
              << " mm: set cut.contact = true, so that they press on each other\n";
  const std::optional<ExpectedError>& expected = r.estimate.expected;
  if (!r.estimate.obstacle.empty())
    std::cerr << "cleft solve: note: " << r.out
              << ": the error of the opening could not be estimated: " << r.estimate.obstacle << "\n";
  if (!expected || expected->total() <= much) return;
  const auto rounded = [](double x) { return shortest(std::round(1000 * x) / 1000); };
  std::cerr
      << "cleft solve: warning: " << r.out << ": the opening is expected to be off by "
      << rounded(expected->total()) << " of it (mesh " << rounded(expected->mesh) << ", patch "
      << rounded(expected->patch)
      << "): make mesh.element_size smaller, or patch.length and patch.width larger; cleft advise chooses\n";
}

Body body_from(const std::string& file) {
  constexpr std::array surfaces = {".stl", ".obj", ".ply", ".vtp", ".vtu", ".glb", ".gltf"};
  if (std::ranges::any_of(surfaces, [&](const char* ending) { return file.ends_with(ending); }))
    throw InputError("--mesh " + file + ": is no body yet; make one of it: cleft body --mesh " + file +
                     " --path cut.csv --out body.h5");
  return read_body(file);
}

void warn_of_turn(const Body& body, const CaseToSolve& one) {
  if (!lacks_stiffness_of_tension(one.parameters)) return;
  const SnapshotReader series(one.out);
  const Turn most = most_turned_skin(body, series.displacement(series.snapshot().frames() - 1));
  if (most.angle <= much_turn) return;
  const auto rounded = [](double x) { return shortest(std::round(100 * x) / 100); };
  std::cerr << "cleft solve: warning: " << one.out << ": skin turns by up to "
            << shortest(std::round(most.angle * 180 / std::numbers::pi)) << " degrees, at ("
            << rounded(most.at.x) << ", " << rounded(most.at.y) << ", " << rounded(most.at.z)
            << ") mm, for which strains are not small, and the wound is too wide: set "
               "skin.turning_stiffness = "
            << shortest(std::max(0.01, std::round(100 * turning_share(most.angle)) / 100))
            << ", as simulated wounds have, or model = finite\n";
}

/// Of cases that are not solved.
void write_meshes(const std::vector<CaseToSolve>& cases, const SolveOptions& options, bool as_json) {
  if (options.body) throw InputError("--unsolved: is for patches; the body's file is its mesh");
  Json list = Json::array();
  for (const CaseToSolve& one : cases) {
    write_unsolved(one.parameters, one.out, MPI_COMM_WORLD);
    list.push_back({{"out", one.out}});
  }
  if (as_json) print_figures(list, true);
}

}  // namespace

int main(int argc, char** argv) {
  MpiSession mpi(argc, argv);
  const bool root = mpi.rank() == 0;
  if (!root) mpi.silence();  // one voice for all ranks

  CommandLine app(
      "Solves a growing cut and writes its time series. Cases of the same stiffness share its factorisation. "
      "Runs under mpirun too.",
      "cleft solve");
  std::vector<std::string> case_files, assignments;
  std::string out, body;
  SolveOptions options;
  bool json = false, verbose = false;
  std::string method = "auto", partitioner = "metis";
  const std::map<std::string, Method> methods = {
      {"auto", Method::automatic}, {"direct", Method::direct}, {"iterative", Method::iterative}};
  const std::map<std::string, Partitioner> partitioners = {
      {"metis", Partitioner::metis}, {"zorder", Partitioner::zorder}, {"zoltan", Partitioner::zoltan}};
  app.add_option("CASE.toml", case_files, "case files")->required();
  app.add_option("--out", out, "snapshot to write, case.h5; for several cases a folder: DIR/CASE.h5")
      ->required();
  app.add_option("--mesh", body,
                 "body.h5 of cleft body: solve its cuts in place of a patch; of cut, patch and mesh, cases "
                 "then use cut.contact and patch.height (the thickness of tissue on bone) alone");
  app.add_option("--set", assignments, "NAME=VALUE: overrides a parameter of the cases (repeatable)")
      ->allow_extra_args(false);
  app.add_option(
         "--method", method,
         "direct: one factorisation for all frames; iterative: conjugate gradients, for what does not fit "
         "into memory or takes minutes; auto: direct where it fits and takes less")
      ->check(one_of({"auto", "direct", "iterative"}))
      ->capture_default_str();
  app.add_option("--partitioner", partitioner, "who divides the elements among ranks")
      ->check(one_of({"metis", "zorder", "zoltan"}))
      ->capture_default_str();
  app.add_flag(
      "--unit-prestress", options.unit_prestress,
      "write the series per unit of skin.prestress_u, _v and _uv too, of which any other prestress is a sum");
  app.add_option("--sensitivities", options.sensitivities,
                 "NAME,...: write the derivative of the series with respect to these parameters, mm per unit "
                 "(default: what the case files say)")
      ->delimiter(',')
      ->allow_extra_args(false);
  bool no_estimate = false, unsolved = false;
  app.add_flag("--no-estimate", no_estimate,
               "do not estimate, by coarser meshes, which error of the opening mesh and patch leave");
  app.add_flag("--unsolved", unsolved,
               "solve nothing: write the mesh, the cut and the times, with displacements of 0");
  app.add_flag("--json", json, "print the figures as JSON; several cases: a list");
  app.add_flag(
      "--verbose", verbose,
      "print the residuals of Newton's method, and in brackets the iterations of its steps, frame by "
      "frame");
  app.footer([] { return parameter_help(); });

  const int code = run_command(app, argc, argv, [&] {
    options.method = methods.at(method), options.estimate = !no_estimate;
    options.discretization.partitioner = partitioners.at(partitioner);
    const std::vector<std::string> outs = outputs_of(case_files, out, ".h5", "case");
    if (!body.empty()) options.body = std::make_shared<const Body>(body_from(body));
    std::vector<CaseToSolve> cases;
    std::string taken_body;
    Mistakes mistakes;
    for (std::size_t c = 0; c < case_files.size(); ++c)
      mistakes.collect([&] {
        refuse_to_overwrite(outs[c], case_files);
        if (options.body) refuse_to_overwrite(outs[c], {body});
        const Case one = read_case(case_files[c], assignments);
        if (body.empty()) take_body(one, c == 0, case_files[c], taken_body, options);
        cases.push_back(
            {options.body ? parameters_of(*options.body, one.parameters) : one.parameters, outs[c]});
        if (app.count("--sensitivities") == 0) take_sensitivities(one, c == 0, case_files[c], options);
        check_options(cases.back().parameters, options, case_files[c]);
      });
    mistakes.throw_if_any();
    if (unsolved) return write_meshes(cases, options, root && json);
    if (root && verbose)
      options.log = [](const std::string& line) { std::cerr << line + '\n' << std::flush; };
    Progress progress("solving");
    const std::vector<SolveReport> reports =
        solve_cases(cases, options, MPI_COMM_WORLD, [&](const std::string& state) {
          if (root) progress(state);
        });
    std::string failures;
    Json list = Json::array();
    for (const SolveReport& report : reports)
      if (report.failure.empty()) {
        list.push_back(figures_of(report));
        if (root) warn_of(report);
        if (root && options.body) warn_of_turn(*options.body, cases[&report - reports.data()]);
      } else {
        failures += (failures.empty() ? "" : "\n  ") + report.out + ": " + report.failure;
      }
    if (root && json && cases.size() > 1)
      print_figures(list, true);
    else if (root)
      for (Json& figures : list) {
        if (!json) figures.erase("newton");  // --verbose prints it for people
        print_figures(figures, json);
      }
    if (!failures.empty()) throw std::runtime_error(failures);
  });
  if (code == 1) mpi.abort(code);
  return code;
}
