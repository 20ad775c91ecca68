// Every frame of all solvers against the saddle-point system with its multipliers written out, in one dense
// matrix. CMakeLists.txt runs these tests on several ranks too.
#include "solver/frame_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "solver/algebraic_solver.h"
#include "solver/direct_solver.h"
#include "solver/grid_solver.h"
#include "tests/solver/dense_patch.h"
#include "tests/support/even_piece.h"

namespace cleft {

namespace {

/// What a frame may differ by, / its norm. The condition of these K is below 1e5: a direct solve loses five
/// of sixteen digits; an iterative one has five of the 1e-13 its residual is made as small as.
constexpr double direct_tolerance = 1e-10, iterative_tolerance = 1e-9, small_residual = 1e-14;

/// The case's own load, and one that pulls at every unknown.
Eigen::MatrixXd two_loads(const DensePatch& patch) {
  std::srand(7);
  Eigen::MatrixXd loads(patch.system.size(), 2);
  loads << patch.load, 1e-3 * Eigen::VectorXd::Random(patch.system.size());
  return loads;
}

/// The solvers of a patch.
struct Solvers {
  explicit Solvers(const DensePatch& patch)
      : direct(patch.mesh, patch.system),
        grid(patch.mesh, patch.system),
        algebraic(patch.mesh, patch.system) {
    direct.factorize();
  }
  template <class Visit>
  void each(const Visit& visit) {
    visit("direct", direct, direct_tolerance);
    visit("grid", grid, iterative_tolerance);
    visit("algebraic", algebraic, iterative_tolerance);
  }
  DirectSolver direct;
  GridSolver grid;
  AlgebraicSolver algebraic;
};

/// Large enough for several levels of the multigrid, which solves the small patches in one.
Parameters larger_patch() {
  Parameters p = dense_patch_case();
  p.patch.length = 24, p.patch.width = 16, p.patch.height = 5;
  p.cut.length = 12, p.cut.branch = 3;
  return p;
}

void expect_all_frames(const DensePatch& patch, const Release& release, Solvers& solvers) {
  const Eigen::MatrixXd loads = two_loads(patch);
  std::vector<Eigen::MatrixXd> expected;
  for (const int open : release.released)
    expected.push_back(patch.solve(patch.closure(release, open), loads));
  EXPECT_GT((expected.back() - expected.front()).col(0).norm(), 0.05 * expected.front().col(0).norm())
      << "the cut must open for this to mean anything";
  std::vector<FrameSolver::Column> columns;
  for (int load = 0; load < 2; ++load)
    for (const int open : release.released) columns.push_back({load, open, false, small_residual});
  solvers.each([&](const char* name, FrameSolver& solver, double tolerance) {
    solver.set_release(release);
    solver.set_loads(patch.own(loads));
    const Eigen::MatrixXd frames = patch.whole(solver.solve(columns));
    for (std::size_t j = 0; j < expected.size(); ++j)
      for (int load = 0; load < 2; ++load) {
        const Eigen::VectorXd of_load = expected[j].col(load);
        const auto column = static_cast<Eigen::Index>(load * expected.size() + j);
        EXPECT_LT((frames.col(column) - of_load).norm(), tolerance * of_load.norm())
            << name << ", frame " << j << ", load " << load;
      }
  });
}

}  // namespace

TEST(FrameSolver, FramesAreThoseWithMultipliers) {
  for (const DenseCase& c : dense_cases()) {
    SCOPED_TRACE(c.name);
    const DensePatch patch(c.parameters);
    Solvers solvers(patch);
    expect_all_frames(patch, patch.release, solvers);
    EXPECT_EQ(solvers.grid.iterations().size(), 2 * patch.release.released.size());
    EXPECT_EQ(solvers.algebraic.iterations().size(), 2 * patch.release.released.size());
    EXPECT_TRUE(solvers.direct.iterations().empty());
  }
}

TEST(FrameSolver, AnotherCutOfTheSameMeshNeedsNoOtherSolver) {
  Parameters longer = dense_patch_case(), shorter = longer;
  longer.mesh.cut_length = shorter.mesh.cut_length = 6;
  longer.mesh.cut_depth = shorter.mesh.cut_depth = 2;
  shorter.cut.length = 4, shorter.cut.depth = 1, shorter.cut.frames = FrameEvery::pair;
  const DensePatch patch(longer);
  Solvers solvers(patch);
  for (const Parameters& p : {longer, shorter, longer})
    expect_all_frames(patch, make_release(patch.mesh, p), solvers);
}

TEST(FrameSolver, ColumnsComeInAnyOrder) {
  const DensePatch patch(dense_patch_case());
  Solvers solvers(patch);
  const Eigen::MatrixXd loads = two_loads(patch);
  solvers.each([&](const char* name, FrameSolver& solver, double tolerance) {
    solver.set_release(patch.release);
    solver.set_loads(patch.own(loads));
    for (const auto& [load, open] : {std::pair(1, 10), {0, 0}, {1, 3}, {0, 4}}) {
      const Eigen::VectorXd frame = patch.whole(solver.solve({{load, open, false, small_residual}}));
      const Eigen::VectorXd expected = patch.solve(patch.closure(patch.release, open), loads.col(load));
      EXPECT_LT((frame - expected).norm(), tolerance * expected.norm())
          << name << ": " << load << ", " << open;
    }
  });
}

/// The closed patch is the reference state: nothing moves, to the last bit, by any solver, whatever the
/// cut.
TEST(FrameSolver, FramesBeginAtZeroWhereTheSkinIsHeld) {
  for (DenseCase one : dense_cases()) {
    SCOPED_TRACE(one.name);
    one.parameters.skin.edges = SkinEdges::held;
    const DensePatch patch(one.parameters);
    Solvers solvers(patch);
    const int open = patch.release.released.back();
    const Eigen::VectorXd expected = patch.solve(patch.closure(patch.release, open), patch.load);
    solvers.each([&](const char* name, FrameSolver& solver, double tolerance) {
      SCOPED_TRACE(name);
      solver.set_release(patch.release);
      solver.set_loads(patch.own(patch.load));
      const Eigen::MatrixXd frames =
          patch.whole(solver.solve({{0, 0, false, small_residual}, {0, open, false, small_residual}}));
      EXPECT_EQ(frames.col(0).cwiseAbs().maxCoeff(), 0);
      EXPECT_LT((frames.col(1) - expected).norm(), tolerance * expected.norm());
    });
  }
}

TEST(FrameSolver, IterationsAgreeWithTheFactorOnALargerPatch) {
  const Parameters p = larger_patch();
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  ASSERT_GT(system.size(), 7000);
  const Release release = make_release(mesh, p);
  DirectSolver direct(mesh, system);
  direct.factorize();
  GridSolver grid(mesh, system);
  AlgebraicSolver algebraic(mesh, system);
  std::vector<FrameSolver::Column> columns;
  for (const int open : release.released) columns.push_back({0, open, false, 1e-12});
  for (FrameSolver* solver : std::initializer_list<FrameSolver*>{&direct, &grid, &algebraic}) {
    solver->set_release(release);
    solver->set_loads(system.load(p.skin));
  }
  const Block expected = direct.solve(columns);
  for (FrameSolver* solver : std::initializer_list<FrameSolver*>{&grid, &algebraic}) {
    const Block frames = solver->solve(columns);
    double largest[] = {(frames - expected).cwiseAbs().maxCoeff(), expected.cwiseAbs().maxCoeff()};
    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LT(largest[0], iterative_tolerance * largest[1]);
  }
  for (const int n : algebraic.iterations())
    EXPECT_LT(n, 22) << "18 were seen, and 23 with a wrong rigid mode";
  for (const int n : grid.iterations()) EXPECT_LT(n, 13);
}

/// The equations are linear, and a power of two changes no digit: not in the preconditioner's single
/// precision either, whose least number is about 1e-38.
TEST(FrameSolver, IterationsKeepTheDigitsOfTinyAndHugeLoads) {
  const Parameters p = larger_patch();
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const Release release = make_release(mesh, p);
  GridSolver grid(mesh, system);
  grid.set_release(release);
  const auto frame = [&](double factor) {
    grid.set_loads(factor * system.load(p.skin));
    return Block(grid.solve({{0, release.released.back()}}) / factor);
  };
  const Block expected = frame(1);
  for (const int power : {-200, -20, 3, 200})
    EXPECT_EQ((frame(std::ldexp(1, power)) - expected).cwiseAbs().sum(), 0) << power;
}

TEST(FrameSolver, LipsBesideTheTipMoveSmoothlyFromFrameToFrame) {
  Parameters p = even_piece();
  p.patch.length = 40, p.patch.width = 20, p.patch.height = 5;
  p.cut.length = 26, p.cut.depth = 2;
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const Release release = make_release(mesh, p);
  DirectSolver solver(mesh, system);
  solver.factorize();
  solver.set_release(release);
  solver.set_loads(system.load(p.skin));
  std::vector<FrameSolver::Column> columns;
  for (const int open : release.released) columns.push_back({0, open});
  const Block frames = solver.solve(columns);
  const auto count = static_cast<int>(release.released.size());
  ASSERT_EQ(count, 26);
  double most = 0;
  for (int frame = count / 4 + 1; frame < count - count / 4 - 1; ++frame)
    for (int axis = 0; axis < 3; ++axis)
      for (const bool left : {true, false}) {
        const auto moved = [&](int f) {  // the skin's node that was opened last
          const NodePair& pair = mesh.pairs[release.order[release.released[f - 1]]];
          return frames(system.unknown(left ? pair.left : pair.right, axis), f);
        };
        most = std::max(most, std::abs(moved(frame - 1) - 2 * moved(frame) + moved(frame + 1)));
      }
  // 0.18 % is how smoothly the tip leaves the one end for the other; where diagonals make a chess board,
  // nodes of four and of eight triangles take turns: 4.9 %.
  EXPECT_LT(most, 0.005 * frames.cwiseAbs().maxCoeff());
}

TEST(FrameSolver, MethodIsDirectWhereItFitsUnlessForced) {
  const DensePatch patch(dense_patch_case());
  const auto silent = [](const std::string&) {};
  const auto chosen = [&](Method m) {
    return make_frame_solver(patch.mesh, patch.system, m, many_operations, silent);
  };
  const ChosenSolver automatic = chosen(Method::automatic);
  EXPECT_EQ(automatic.method, Method::direct);
  EXPECT_NE(automatic.reason.find("its factor fits: "), std::string::npos) << automatic.reason;
  EXPECT_EQ(chosen(Method::direct).reason, "forced");
  const ChosenSolver iterative = chosen(Method::iterative);
  EXPECT_EQ(iterative.method, Method::iterative);
  EXPECT_EQ(iterative.reason, "forced");
  const ChosenSolver quicker = make_frame_solver(patch.mesh, patch.system, Method::automatic, 1, silent);
  EXPECT_EQ(quicker.method, Method::iterative);
  EXPECT_NE(quicker.reason.find("a factor would take longer: "), std::string::npos) << quicker.reason;
  EXPECT_EQ(make_frame_solver(patch.mesh, patch.system, Method::direct, 1, silent).method, Method::direct);
}

TEST(FrameSolver, WhatCannotBeAssembledIsRefusedBefore) {
  check_assembly_fits(100000, MPI_COMM_WORLD);
  try {
    check_assembly_fits(2000000000, MPI_COMM_WORLD);
    FAIL() << "3 TB were free";
  } catch (const InputError& e) {
    for (const char* part : {"2000000000 unknowns need ", " GB free", "mesh.element_size"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

/// As tangents follow one another; each factor uses the analysis and the memory of the first.
TEST(FrameSolver, FactorsOfFurtherMatricesAreTheirOwn) {
  const DensePatch patch(dense_patch_case());
  DirectSolver solver(patch.mesh, patch.system);
  solver.factorize();
  const Eigen::MatrixXd load = two_loads(patch).col(1);
  const int open = patch.release.released[1];
  for (const double factor : {3., 0.2, 1.}) {
    PatchSystem::Entries entries = patch.system.lower_triangle();
    for (std::size_t i = 0; i < entries.value.size(); ++i)
      entries.value[i] = factor * entries.value[i] + (entries.row[i] == entries.column[i] ? 0.1 : 0);
    const Eigen::MatrixXd k = factor * patch.stiffness +
                              0.1 * Eigen::MatrixXd::Identity(patch.stiffness.rows(), patch.stiffness.rows());
    solver.replace(std::move(entries));
    solver.factorize();
    solver.set_release(patch.release);
    const Eigen::MatrixXd expected = solve_with_multipliers(k, patch.closure(patch.release, open), load);
    const Eigen::MatrixXd found = patch.whole(solver.solve_once(patch.own(load), open));
    EXPECT_LT((found - expected).norm(), direct_tolerance * expected.norm()) << factor;
  }
}

}  // namespace cleft
