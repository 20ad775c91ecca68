// A patch with its whole system in one dense matrix: the independent answer to what the frame solvers find.
#pragma once

#include <Eigen/Dense>
#include <numeric>
#include <vector>

#include "params/consistency.h"
#include "solver/block_rows.h"
#include "solver/frame_solver.h"
#include "tests/solver/small_patch.h"
#include "tests/support/even_piece.h"

namespace cleft {

/// The paper's own system, written out: K u + C^T v = f, C u = 0; u, a column for each of the loads.
inline Eigen::MatrixXd solve_with_multipliers(const Eigen::MatrixXd& k, const Eigen::MatrixXd& c,
                                              const Eigen::MatrixXd& loads) {
  const Eigen::Index n = k.rows(), rows = c.rows();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + rows, n + rows);
  matrix.topLeftCorner(n, n) = k;
  matrix.bottomLeftCorner(rows, n) = c;
  matrix.topRightCorner(n, rows) = c.transpose();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + rows, loads.cols());
  right.topRows(n) = loads;
  return matrix.partialPivLu().solve(right).topRows(n);
}

/// The same on every rank of the communicator.
class DensePatch {
 public:
  explicit DensePatch(const Parameters& p, const Discretization& discretization = {},
                      MPI_Comm communicator = MPI_COMM_WORLD)
      : mesh(make_patch_mesh(p)),
        system(mesh, p, communicator, discretization),
        release(make_release(mesh, p)) {
    const PatchSystem::Entries entries = system.lower_triangle();
    stiffness = Eigen::MatrixXd::Zero(system.size(), system.size());
    for (std::size_t i = 0; i < entries.value.size(); ++i)
      stiffness(entries.row[i], entries.column[i]) = stiffness(entries.column[i], entries.row[i]) =
          entries.value[i];
    MPI_Allreduce(MPI_IN_PLACE, stiffness.data(), static_cast<int>(stiffness.size()), MPI_DOUBLE, MPI_SUM,
                  system.communicator());
    load = whole(system.load(p.skin));
  }

  /// All rows of a distributed block.
  Eigen::MatrixXd whole(const Block& block) const {
    std::vector<int> all(static_cast<std::size_t>(system.size()));
    std::iota(all.begin(), all.end(), 0);
    Eigen::MatrixXd rows = gather_rows(system, block, all);
    rows.resize(system.size(), block.cols());  // empty but on rank 0
    MPI_Bcast(rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, 0, system.communicator());
    return rows;
  }

  /// The rows that this rank owns.
  Block own(const Eigen::MatrixXd& rows) const { return rows.middleRows(system.first(), system.owned()); }

  /// Rows d . (u_right - u_left) of pairs: `directions(pair)` lists the d.
  template <class Directions>
  Eigen::MatrixXd jumps(const std::vector<int>& pairs, const Directions& directions) const {
    std::vector<Eigen::RowVectorXd> rows;
    for (const int p : pairs)
      for (const Vec3& d : directions(p)) {
        Eigen::RowVectorXd& row = rows.emplace_back(Eigen::RowVectorXd::Zero(system.size()));
        for (int axis = 0; axis < 3; ++axis) {
          row(system.unknown(mesh.pairs[p].right, axis)) += d[axis];
          row(system.unknown(mesh.pairs[p].left, axis)) -= d[axis];
        }
      }
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), system.size());
    for (std::size_t r = 0; r < rows.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = rows[r];
    return matrix;
  }

  /// C of the pairs that a release has not opened yet.
  Eigen::MatrixXd closure(const Release& r, int open) const {
    return jumps({r.order.begin() + open, r.order.end()}, [](int) {
      return std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    });
  }

  /// Normal gaps of the pairs that it has opened.
  Eigen::MatrixXd gaps(const Release& r, int open) const {
    return jumps({r.order.begin(), r.order.begin() + open},
                 [this](int p) { return std::vector<Vec3>{mesh.pairs[p].normal}; });
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& constraints, const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd u(loads.rows(), loads.cols());
    if (system.rank() == 0) u = solve_with_multipliers(stiffness, constraints, loads);
    MPI_Bcast(u.data(), static_cast<int>(u.size()), MPI_DOUBLE, 0, system.communicator());
    return u;
  }

  PatchMesh mesh;
  PatchSystem system;
  Release release;
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd load;
};

/// Smaller than small_patch(), for dense matrices: 570 unknowns. No symmetry that could hide a mistake.
inline Parameters dense_patch_case() {
  Parameters p = even_piece();
  p.patch.length = 8, p.patch.width = 4, p.patch.height = 3;
  p.cut.length = 6, p.cut.depth = 2;
  p.skin.prestress = {0.02, 0.03, 0.012};
  return p;
}

struct DenseCase {
  const char* name;
  Parameters parameters;
};

/// One of everything that changes K, the pairs or the order in which they open.
inline std::vector<DenseCase> dense_cases() {
  std::vector<DenseCase> cases;
  const auto add = [&](const char* name, auto&& change) {
    Parameters p = dense_patch_case();
    change(p);
    check_consistency(p, name);
    cases.push_back({name, p});
  };
  add("Plain", [](Parameters& p) { p.skin.prestress.uv = 0; });
  add("ShearedByPairs", [](Parameters& p) { p.cut.frames = FrameEvery::pair; });
  add("TiltedArc", [](Parameters& p) { p.cut.radius = 12, p.cut.tilt = 15; });
  add("ParallelCuts", [](Parameters& p) { p.cut.count = 2, p.cut.spacing = 1.6, p.cut.length = 4; });
  add("Branch", [](Parameters& p) { p.cut.branch = 1, p.cut.length = 4, p.cut.frames = FrameEvery::pair; });
  add("MeshOfALargerCut",
      [](Parameters& p) { p.mesh.cut_length = 6, p.mesh.cut_depth = 2, p.cut.length = 4, p.cut.depth = 1; });
  add("BranchInAMeshOfALargerCut", [](Parameters& p) {
    p.cut.branch = 1, p.cut.length = 3, p.mesh.cut_length = 6, p.cut.frames = FrameEvery::pair;
  });
  add("Graded", [](Parameters& p) { p.mesh.grading = 1.5, p.patch.length = 11, p.patch.width = 6; });
  add("MeanDilatation", [](Parameters& p) {
    p.tissue.formulation = TissueFormulation::mean_dilatation, p.tissue.poisson_ratio = 0.495;
  });
  add("TissueUnderStress", [](Parameters& p) { p.tissue.prestress_share = 0.4; });
  add("EffectiveFront",
      [](Parameters& p) { p.mesh.front = MeshFront::effective, p.patch.length = 9, p.cut.depth = 1.5; });
  add("InitialStressStiffness", [](Parameters& p) { p.skin.initial_stress_stiffness = true; });
  add("TurningStiffness", [](Parameters& p) { p.skin.turning_stiffness = 0.7; });
  return cases;
}

}  // namespace cleft
