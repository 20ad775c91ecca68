// cleft residual: how far the displacements of snapshots are from the solutions of their cases.
#include <cmath>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "params/study.h"
#include "solver/mpi_session.h"
#include "solver/residual_bound.h"

using namespace cleft;

namespace {

Json to_json(const std::string& file, const SnapshotBound& found, const Snapshot& snapshot) {
  Json json = {{"snapshot", file},
               {"stiffness_ratios", {found.ratios.least, found.ratios.greatest}},
               {"bound_over_error_at_most", std::sqrt(found.ratios.greatest / found.ratios.least)},
               {"closed_pairs_moved_mm", found.moved},
               {"frames", Json::array()}};
  for (std::size_t j = 0; j < found.frames.size(); ++j) {
    const FrameBound& frame = found.frames[j];
    Json one = {{"length_cut_mm", snapshot.times[j]}, {"bound", frame.bound}, {"size", frame.size}};
    if (frame.error) one["error"] = *frame.error;
    json["frames"].push_back(one);
  }
  return json;
}

void print(const Json& one) {
  const Json& last = one["frames"].back();
  std::cout << one["snapshot"].get<std::string>() << ": in the last frame the error is at most "
            << last["bound"].get<double>() << " of " << last["size"].get<double>()
            << " (N mm)^1/2 in the norm of the energy";
  if (last.contains("error")) std::cout << "; it is " << last["error"].get<double>();
  std::cout << "; the bound is at most " << one["bound_over_error_at_most"].get<double>()
            << " times the error\n";
}

}  // namespace

int main(int argc, char** argv) {
  MpiSession mpi(argc, argv);
  const bool root = mpi.rank() == 0;
  if (!root) mpi.silence();

  CommandLine app(
      "Bounds how far the displacements of snapshots are from the solutions of their cases, in the norm of "
      "the energy, frame by frame, by the factor of one reference case. For small strains without contact.",
      "cleft residual");
  std::vector<std::string> files;
  std::string reference;
  bool solve = false, json = false;
  app.add_option("SNAPSHOT.h5", files, "snapshots of one mesh")->required();
  app.add_option("--reference", reference,
                 "CASE.toml of the same mesh, whose stiffness is factorised (default: that of the first "
                 "snapshot, with which the bound of its own is the error)");
  app.add_flag("--solve", solve, "solve the cases too, and tell the error itself");
  app.add_flag("--json", json, "print all frames as JSON: a list, of each snapshot");
  const int code = run_command(app, argc, argv, [&] {
    std::vector<std::unique_ptr<SnapshotReader>> readers;
    Mistakes mistakes;
    for (const std::string& file : files)
      mistakes.collect([&] {
        readers.push_back(std::make_unique<SnapshotReader>(file));
        parameters_to_bound(readers.back()->snapshot(), file);
      });
    mistakes.throw_if_any();
    const Parameters of = reference.empty() ? parameters_to_bound(readers.front()->snapshot(), files.front())
                                            : read_case(reference, {}).parameters;
    Progress progress("bounding");
    ResidualBound bound(of, MPI_COMM_WORLD, [&](const std::string& state) {
      if (root) progress(state);
    });
    Json list = Json::array();
    for (std::size_t i = 0; i < files.size(); ++i)
      list.push_back(to_json(files[i], bound.of(*readers[i], solve, files[i]), readers[i]->snapshot()));
    if (!root) return;
    if (json) return print_figures(list, true);
    for (const Json& one : list) print(one);
  });
  if (code == 1) mpi.abort(code);
  return code;
}
