#include "solver/residual_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"

namespace cleft {

namespace {

constexpr Eigen::Index columns_at_once = 16;  // of displacements held at a time

/// Nodes that stay together in a frame have their mean; returns the largest distance from it.
double put_together(const PatchMesh& mesh, const Release& release, int open, std::vector<Vec3>& nodes) {
  std::vector<int> first(nodes.size());
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](int node) {
    while (first[static_cast<std::size_t>(node)] != node) node = first[static_cast<std::size_t>(node)];
    return node;
  };
  std::vector<int> of_cut;
  for (std::size_t k = static_cast<std::size_t>(open); k < release.order.size(); ++k) {
    const NodePair& pair = mesh.pairs[static_cast<std::size_t>(release.order[k])];
    first[static_cast<std::size_t>(root(pair.right))] = root(pair.left);
    of_cut.insert(of_cut.end(), {pair.left, pair.right});
  }
  std::sort(of_cut.begin(), of_cut.end());
  of_cut.erase(std::unique(of_cut.begin(), of_cut.end()), of_cut.end());
  std::vector<Vec3> sums(nodes.size());
  std::vector<int> counts(nodes.size(), 0);
  for (const int node : of_cut) {
    const auto at = static_cast<std::size_t>(root(node));
    sums[at] = sums[at] + nodes[static_cast<std::size_t>(node)], ++counts[at];
  }
  double moved = 0;
  for (const int node : of_cut) {
    const auto at = static_cast<std::size_t>(root(node));
    const Vec3 mean = (1. / counts[at]) * sums[at];
    moved = std::max(moved, norm(mean - nodes[static_cast<std::size_t>(node)]));
    nodes[static_cast<std::size_t>(node)] = mean;
  }
  return moved;
}

/// Nodes in the middle of quadratic elements' faces have no unknowns of their own: their rows are 0.
void set_column(const PatchSystem& system, const PatchMesh& mesh, const std::vector<Vec3>& nodes,
                Block& block, Eigen::Index column) {
  const std::vector<bool> in_face = in_faces(mesh);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (const int row = system.row(system.unknown(static_cast<int>(n), axis)); row >= 0)
        block(row, column) = in_face[n] ? 0 : nodes[n][axis];
}

/// Of each column with the same one of another block, over all ranks.
Eigen::VectorXd products(const PatchSystem& system, const Block& a, const Block& b) {
  Eigen::VectorXd sums = a.cwiseProduct(b).colwise().sum().transpose();
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                system.communicator());
  return sums;
}

void check_mesh(const PatchMesh& mesh, const Release& release, const Snapshot& s, const std::string& where) {
  const auto apart = [](const Vec3& a, const Vec3& b) { return norm(a - b) > 1e-9; };
  if (s.points.size() == mesh.points.size() && s.released == release.released &&
      std::equal(s.points.begin(), s.points.end(), mesh.points.begin(),
                 [&](const Vec3& a, const Vec3& b) { return !apart(a, b); }))
    return;
  throw InputError(
      where +
      ": its nodes or its frames are not those of the mesh of its parameters; write it anew (cleft "
      "solve --unsolved makes the mesh)");
}

}  // namespace

Parameters parameters_to_bound(const Snapshot& s, const std::string& where) {
  if (s.source) throw InputError(where + ": is imported; what its displacements solve is not known");
  if (!s.body.empty()) throw InputError(where + ": is of a body; the bound is for patches so far");
  const Parameters parameters = s.parameters.whole(where, "does not record", "; solve the case again");
  check_linear(parameters, where);
  return parameters;
}

ResidualBound::ResidualBound(const Parameters& reference, MPI_Comm communicator,
                             const std::function<void(const std::string&)>& progress)
    : reference_(reference), communicator_(communicator), progress_(progress) {
  check_linear(reference, "reference");
  progress("meshing and assembling the reference");
  mesh_ = make_patch_mesh(reference);
  check_assembly_fits(3 * mesh_.points.size(), communicator);
  system_ = std::make_unique<PatchSystem>(mesh_, reference, communicator);
  chosen_ = make_frame_solver(mesh_, *system_, Method::automatic, many_operations, progress);
  chosen_.solver->set_release(make_release(mesh_, reference));
  check_rounding(*system_, chosen_);
}

SnapshotBound ResidualBound::of(const SnapshotReader& reader, bool solve, const std::string& where) {
  const Snapshot& s = reader.snapshot();
  const Parameters parameters = parameters_to_bound(s, where);
  if (mesh_key(parameters) != mesh_key(reference_))
    throw InputError(where +
                     ": its mesh is not that of the reference; give a reference of the same patch, cut "
                     "and mesh");
  const Release release = make_release(mesh_, parameters);
  check_mesh(mesh_, release, s, where);
  SnapshotBound result;
  result.ratios = stiffness_ratios(parameters, reference_);
  if (!(result.ratios.least > 0))
    throw InputError(where + ": a stiffness that the reference has is 0 here; take another reference");
  progress_("assembling " + where);
  const PatchSystem system(mesh_, parameters, communicator_);
  const Block load = system.load(parameters.skin);
  ChosenSolver own;
  if (solve) {
    own = make_frame_solver(mesh_, system, Method::automatic, many_operations, progress_);
    own.solver->set_release(release);
    check_rounding(system, own);
  }
  chosen_.solver->set_release(release);
  const Work work{reader, system, release, load, own.solver.get()};
  const auto frames = static_cast<Eigen::Index>(s.frames());
  for (Eigen::Index first = 0; first < frames; first += columns_at_once) {
    progress_("frame " + std::to_string(first + 1) + " of " + std::to_string(frames));
    add_frames(work, first, std::min(columns_at_once, frames - first), result);
  }
  return result;
}

void ResidualBound::add_frames(const Work& work, Eigen::Index first, Eigen::Index count,
                               SnapshotBound& result) {
  const PatchSystem& system = work.system;
  Block shown = Block::Zero(system.owned(), count);
  std::vector<FrameSolver::Column> columns, under_load;
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto frame = static_cast<std::size_t>(first + j);
    std::vector<Vec3> nodes = work.reader.displacement(frame);
    const int open = work.release.released[frame];
    result.moved = std::max(result.moved, put_together(mesh_, work.release, open, nodes));
    set_column(system, mesh_, nodes, shown, j);
    columns.push_back({static_cast<int>(j), open, false, 1e-10});
    under_load.push_back({0, open, false, 1e-10});
  }
  const Block forces = system.multiply(shown);
  const Block residual = (-forces).colwise() + Eigen::VectorXd(work.load.col(0));
  chosen_.solver->set_loads(residual);
  const Eigen::VectorXd dual = products(system, residual, chosen_.solver->solve(columns)),
                        squares = products(system, shown, forces);
  Eigen::VectorXd errors;
  if (work.own) {
    work.own->set_loads(work.load);
    const Block error = work.own->solve(under_load) - shown;
    errors = products(system, error, system.multiply(error));
  }
  for (Eigen::Index j = 0; j < count; ++j) {
    FrameBound& frame = result.frames.emplace_back();
    frame.bound = std::sqrt(std::max(0., dual[j]) / result.ratios.least);
    frame.size = std::sqrt(std::max(0., squares[j]));
    if (work.own) frame.error = std::sqrt(std::max(0., errors[j]));
  }
}

}  // namespace cleft
