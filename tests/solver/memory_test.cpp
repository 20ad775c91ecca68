// The estimated memory of the direct solver against what it takes.
#include "base/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "solver/direct_solver.h"
#include "tests/solver/small_patch.h"
#include "tests/support/even_piece.h"

namespace cleft {

namespace {

double total_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace

TEST(Memory, AvailableIsPartOfTheMachines) {
  EXPECT_GT(available_memory(), 0);
  EXPECT_LE(available_memory(), total_memory());
}

/// What is promised must be enough, for the choice of the method trusts it, and no more than twice what is
/// needed: MUMPS tells its workspace beforehand from the structure of K alone, room is left for blocks of 64
/// frames, of which this cut has 20, and rounding up to pages and heaps adds a little.
TEST(Memory, OfTheDirectSolverIsWhatItSaysBeforehand) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory would be counted too";
#endif
  Parameters p = even_piece();
  p.mesh.element_size = 1.5;
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const Release release = make_release(mesh, p);
  ASSERT_GT(system.size(), 20000);
  const double before = held_memory();
  DirectSolver solver(mesh, system);
  const double needed = solver.bytes_needed();
  EXPECT_GT(solver.operations(), 1e7);
  solver.factorize();
  solver.set_release(release);
  solver.set_loads(system.load(p.skin));
  std::vector<FrameSolver::Column> columns;
  for (const int open : release.released) columns.push_back({0, open});
  const Block frames = solver.solve(columns);
  const double taken = peak_memory() - before;
  EXPECT_LT(taken, needed);
  EXPECT_GT(taken, needed / 2);
  EXPECT_GT(frames.norm(), 0);
}

TEST(Memory, PeakFollowsWhatIsTaken) {
  const double before = peak_memory();
  EXPECT_GT(before, 1e6);
  EXPECT_LT(before, total_memory());
  constexpr std::size_t taken = 600'000'000;
  std::vector<char> block(taken, 1);
  EXPECT_EQ(block[taken / 2], 1);
  EXPECT_GT(peak_memory(), taken);
  EXPECT_GE(peak_memory(), before);
}

}  // namespace cleft
