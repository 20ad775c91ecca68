// What cannot be solved is told on every rank. CMakeLists.txt runs these tests on several ranks too.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/direct_solver.h"
#include "solver/grid_solver.h"
#include "tests/solver/small_patch.h"

namespace cleft {

namespace {

/// A skin so compressed that it buckles, which check_consistency() would refuse.
Parameters buckling_patch(double compression, double cut_length) {
  Parameters p = small_patch();
  p.cut.length = cut_length, p.cut.depth = 1;
  p.skin.prestress.uu = p.skin.prestress.vv = -compression;
  p.skin.initial_stress_stiffness = true;
  return p;
}

std::string failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const SolveError& e) {
    return e.what();
  }
  return "";
}

void expect_not_positive_definite(const std::string& failure) {
  EXPECT_NE(failure.find("not positive definite"), std::string::npos) << failure;
  EXPECT_NE(failure.find("springs and moduli"), std::string::npos) << failure;
}

}  // namespace

/// Barely and much too compressed, and with the cut's own share of the stiffness sound or not.
TEST(Unsolvable, ABucklingPatchFailsOnEveryRank) {
  for (const double cut_length : {2., 6.})
    for (const double compression : {0.003, 0.02, 0.5}) {
      const Parameters p = buckling_patch(compression, cut_length);
      const PatchMesh mesh = make_patch_mesh(p);
      const PatchSystem system(mesh, p, MPI_COMM_WORLD);
      expect_not_positive_definite(failure_of([&] {
        DirectSolver direct(mesh, system);
        direct.factorize();
      }));
      if (compression < 0.01) continue;  // iterations need not meet a mode that the load hardly excites
      expect_not_positive_definite(failure_of([&] {
        GridSolver iterative(mesh, system);
        iterative.set_release(make_release(mesh, p));
        iterative.set_loads(system.load(p.skin));
        iterative.solve({{0, 0}});
      }));
      MPI_Barrier(MPI_COMM_WORLD);  // all ranks are still in step
    }
}

/// On all ranks, though one alone has the value.
TEST(Unsolvable, IterationsRefuseLoadsThatAreNotNumbers) {
  const Parameters p = small_patch();
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  GridSolver iterative(mesh, system);
  iterative.set_release(make_release(mesh, p));
  for (const double value : {std::nan(""), 1e200}) {
    Block load = system.load(p.skin);
    if (system.rank() == 0) load(0, 0) = value;
    iterative.set_loads(load);
    const std::string failure = failure_of([&] { iterative.solve({{0, 2}}); });
    EXPECT_NE(failure.find("skin.prestress"), std::string::npos) << failure;
    MPI_Barrier(MPI_COMM_WORLD);  // all ranks are still in step
  }
}

TEST(Unsolvable, IterationsRefuseContact) {
  const Parameters p = small_patch();
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  GridSolver iterative(mesh, system);
  iterative.set_release(make_release(mesh, p));
  iterative.set_loads(system.load(p.skin));
  const std::string failure = failure_of([&] { iterative.solve({{0, 2, true}}); });
  for (const char* part : {"cut.contact = true", "--method direct", "mesh.element_size"})
    EXPECT_NE(failure.find(part), std::string::npos) << failure;
}

}  // namespace cleft
