#include "solver/companion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "params/consistency.h"
#include "params/meshed_cut.h"
#include "params/parameters/table.h"
#include "solver/frame_figures.h"
#include "solver/kept_patches.h"

namespace cleft {

namespace {

constexpr double least_grading = 1.3;  // of companions' patches, so that they cost no more than the case
constexpr double greatest_grading = 2;
constexpr double near = 2;                // patch around a short cut, over the cut's length or depth
constexpr double most_finer_nodes = 2e4;  // of a companion with finer elements: a few seconds

Parameters with_grading(Parameters p) {
  p.mesh.grading = std::max(least_grading, p.mesh.grading);
  return p;
}

/// Twice as long and wide.
Parameters in_wider_patch(Parameters p) {
  p.patch.length *= 2, p.patch.width *= 2;
  return with_grading(p);
}

Parameters with_elements(Parameters p, double times) {
  p.mesh.element_size *= times;
  return p;
}

/// Elements far from the cut twice as long: those that grow by g away from it then grow by its square.
Parameters growing_twice_as_fast(Parameters p) {
  p.mesh.grading = std::min(greatest_grading, p.mesh.grading * p.mesh.grading);
  return p;
}

/// In a patch in which the mesh errs as in the whole one. Cuts other than a single straight, upright one keep
/// theirs.
Parameters near_the_cut(Parameters p) {
  if (p.cut.count > 1 || p.cut.branch > 0 || p.cut.radius > 0 || p.cut.tilt != 0 || is_shaped(p))
    return with_grading(p);
  const MeshedCut cut = meshed_cut(p);
  const double margin = near * std::max(cut.length, cut.depth);
  p.patch.length = std::min(p.patch.length, cut.length + 2 * margin);
  p.patch.width = std::min(p.patch.width, 2 * margin);
  return with_grading(p);
}

double change(double from, double to) { return std::abs(to - from) / from; }

/// gape_of() of a companion.
using Gape = std::function<double(const Parameters&)>;

ExpectedError against_coarser(const Parameters& p, double gape, const Gape& gape_of) {
  const Parameters coarse = with_elements(p, 2);
  const double coarser = gape_of(coarse), wider = gape_of(in_wider_patch(coarse));
  // Away from the front errors go as the square of elements' lengths.
  const double growing =
      p.mesh.grading > 1 ? std::abs(gape_of(growing_twice_as_fast(coarse)) - coarser) / 3 : 0;
  return {(std::abs(coarser - gape) + growing) / gape, std::abs(wider - coarser) / gape};
}

/// The error of a mesh goes as the size of its elements, as the energy of a crack does: elements half as long
/// take half of it away.
ExpectedError against_finer(const Parameters& p, const Parameters& coarse, const Parameters& fine,
                            const Gape& gape) {
  return {2 * change(gape(coarse), gape(fine)), change(gape(with_grading(p)), gape(in_wider_patch(p)))};
}

}  // namespace

double gape_of(const Parameters& parameters, MPI_Comm communicator, KeptPatches* kept) {
  check_consistency(parameters, "companion");
  std::shared_ptr<MeshedPatch> patch = kept ? kept->reassembled(parameters) : nullptr;
  if (patch) {
    factorize_again(patch->system, patch->chosen);
  } else {
    PatchMesh mesh = make_patch_mesh(parameters);
    const KeepElements keep = kept ? kept->wants(parameters, mesh) : KeepElements::no;
    patch = std::make_shared<MeshedPatch>(std::move(mesh), parameters, communicator, Discretization(), keep);
    patch->chosen =
        make_frame_solver(patch->mesh, patch->system, Method::automatic,
                          parameters.cut.contact ? std::numeric_limits<double>::infinity() : many_operations,
                          [](const std::string&) {});
    if (kept) kept->keep(parameters, patch);
  }
  const PatchSystem& system = patch->system;
  FrameSolver& solver = *patch->chosen.solver;
  const Release release = make_release(patch->mesh, parameters);
  const Block load = system.load(parameters.skin);
  const std::vector<FrameSolver::Column> columns = {
      {0, release.released.back(), parameters.cut.contact, 1e-6}};
  solver.set_release(release);
  solver.set_loads(load);
  const Block found = solver.solve(columns);
  const FrameResidual residual(patch->mesh, system);
  return residual.figures(release, columns, found, residual.left_over(load, found), 1).front().gape;
}

ErrorEstimate expected_error(const Parameters& parameters, double gape, MPI_Comm communicator,
                             KeptPatches* kept) {
  const Gape gape_of = [&](const Parameters& p) { return cleft::gape_of(p, communicator, kept); };
  if (!(gape > 0)) return {{}, "the cut does not open"};
  Parameters p = parameters;
  try {
    if (p.model == Model::finite) p.model = Model::small, gape = gape_of(p);
    return {against_coarser(p, gape, gape_of), ""};
  } catch (const SolveError& e) {
    return {{}, "with elements twice as long the cut has no solution: " + std::string(e.what())};
  } catch (const InputError&) {  // they do not fit the cut
  }
  const Parameters coarse = near_the_cut(p), fine = with_elements(coarse, 0.5);
  try {
    if (const double nodes = estimated_nodes(fine); nodes > most_finer_nodes)
      return {{},
              "elements twice as long do not fit the cut, and half as long ones would take about " +
                  shortest(std::round(nodes)) + " nodes; solve it with half the " +
                  row_of(p, p.mesh.element_size).name + " and compare"};
    return {against_finer(p, coarse, fine, gape_of), ""};
  } catch (const SolveError& e) {
    return {{}, "with elements half as long the cut has no solution: " + std::string(e.what())};
  } catch (const InputError& e) {
    return {{},
            "elements twice as long do not fit the cut, nor does a mesh to compare with: " +
                std::string(e.what())};
  }
}

}  // namespace cleft
