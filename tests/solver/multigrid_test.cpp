// Transfers of the multigrid between grids whose nodes are doubled along cuts, and how its iterations grow.
#include "solver/multigrid/multigrid.h"

#include <gtest/gtest.h>

#include <random>

#include "solver/grid_solver.h"
#include "tests/solver/dense_patch.h"
#include "tests/solver/small_patch.h"

namespace cleft {

namespace {

/// The grid of a mesh that is no more than scaled along its axes.
DoubledGrid grid_of(const PatchMesh& mesh) {
  std::array<std::vector<double>, 3> places;
  const std::array<int, 3> step = {1, mesh.grid[0], mesh.grid[0] * mesh.grid[1]};
  for (int axis = 0; axis < 3; ++axis)
    for (int line = 0; line < mesh.grid[axis]; ++line)
      places[axis].push_back(mesh.points[static_cast<std::size_t>(line) * step[axis]][axis]);
  std::vector<DoubledGrid::Pair> pairs;
  for (const NodePair& pair : mesh.pairs) pairs.push_back({pair.left, pair.right});
  return {std::move(places), std::move(pairs), mesh.wedges};
}

std::vector<Parameters> cuts() {
  Parameters one = small_patch();
  one.patch.length = 24, one.patch.width = 16, one.patch.height = 6;
  one.cut.length = 12, one.cut.depth = 3;
  one.mesh.grading = 1.3;
  Parameters two = one, branched = one, short_one = one;
  two.cut.count = 2, two.cut.spacing = 4;
  branched.cut.branch = 4;
  short_one.cut.length = 2.5;
  return {one, two, branched, short_one};
}

/// Values of a finer grid's nodes, from those of a coarser one.
double interpolated(const DoubledGrid::Interpolation& interpolation, int node,
                    const std::vector<double>& values) {
  std::vector<DoubledGrid::Share> shares;
  interpolation.shares(node, shares);
  double sum = 0;
  for (const auto& [from, share] : shares) sum += share * values[from];
  return sum;
}

}  // namespace

TEST(Multigrid, LinearFunctionsAreInterpolatedExactly) {
  for (const Parameters& p : cuts()) {
    const PatchMesh mesh = make_patch_mesh(p);
    const DoubledGrid grid = grid_of(mesh);
    std::vector<double> values;
    for (const Vec3& at : mesh.points) values.push_back(1 + 2 * at.x - 3 * at.y + 0.5 * at.z);
    const GridLines coarse = grid.coarser(grid.finest(), 2.4);
    ASSERT_LT(grid.count(coarse), mesh.points.size() / 2);
    const DoubledGrid::Interpolation interpolation(grid, coarse);
    for (int n = 0; n < grid.nodes(); ++n)
      EXPECT_NEAR(interpolated(interpolation, n, values), values[n], 1e-13 * 100) << n;
  }
}

/// With a function that is 1 at the right nodes of a cut and 0 at the others: nothing of it is seen on the
/// left, and at the right nodes a part at least.
TEST(Multigrid, ValuesComeFromTheOwnSideOfTheCut) {
  const PatchMesh mesh = make_patch_mesh(cuts().front());
  const DoubledGrid grid = grid_of(mesh);
  std::vector<double> is_right(mesh.points.size(), 0);
  for (const NodePair& pair : mesh.pairs) is_right[pair.right] = 1;
  const GridLines coarse = grid.coarser(grid.coarser(grid.finest(), 2.4), 4.8);
  const DoubledGrid::Interpolation interpolation(grid, coarse);
  for (const NodePair& pair : mesh.pairs) {
    EXPECT_EQ(interpolated(interpolation, pair.left, is_right), 0) << pair.left;
    EXPECT_GT(interpolated(interpolation, pair.right, is_right), 0) << pair.right;
  }
  for (int n = 0; n < grid.nodes(); ++n) {
    if (mesh.points[n].y < mesh.start.y) {
      EXPECT_EQ(interpolated(interpolation, n, is_right), 0) << n;
    }
  }
}

/// Coarse functions are among the fine ones: random values at a coarse grid's nodes, equal where its pairs
/// are closed, give equal values at all closed pairs of the finest grid.
TEST(Multigrid, CoarseFunctionsKeepClosedPairsClosed) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Parameters& p : cuts()) {
    const PatchMesh mesh = make_patch_mesh(p);
    const Release release = make_release(mesh, p);
    const DoubledGrid grid = grid_of(mesh);
    std::vector<int> opens_after(mesh.pairs.size());
    for (std::size_t i = 0; i < release.order.size(); ++i)
      opens_after[release.order[i]] = static_cast<int>(i);
    GridLines lines = grid.finest();
    std::vector<int> finer = opens_after;
    for (int level = 0; level < 3; ++level) {
      const GridLines coarse = grid.coarser(lines, 2.4 * grid.shortest(lines));
      const std::vector<int> after = grid.opens_after(finer, lines, coarse);
      const DoubledGrid::Interpolation interpolation(grid, coarse);
      for (int open = 0; open <= static_cast<int>(mesh.pairs.size()); ++open) {
        std::vector<double> values(mesh.points.size());
        for (double& value : values) value = any(random);
        for (std::size_t pair = 0; pair < mesh.pairs.size(); ++pair)
          if (open <= after[pair]) values[mesh.pairs[pair].right] = values[mesh.pairs[pair].left];
        for (std::size_t pair = 0; pair < mesh.pairs.size(); ++pair)
          if (grid.has(lines, mesh.pairs[pair].left) && open <= finer[pair]) {
            EXPECT_NEAR(interpolated(interpolation, mesh.pairs[pair].left, values),
                        interpolated(interpolation, mesh.pairs[pair].right, values), 1e-14)
                << "level " << level << ", open " << open << ", pair " << pair;
          }
      }
      if (level == 0) {
        int open_too = 0;
        for (const int pairs : after) open_too += pairs < static_cast<int>(mesh.pairs.size());
        EXPECT_GT(open_too, static_cast<int>(mesh.pairs.size()) / 3) << "coarse pairs open at all";
      }
      finer = after, lines = coarse;
    }
  }
}

/// The last frame, from zero, at sizes and gradings; with nearly incompressible tissue too.
TEST(Multigrid, IterationsHardlyGrowWithSizeGradingAndPoissonsRatio) {
  const auto iterations = [](double element_size, double grading, double nu) {
    Parameters p = small_patch();
    p.patch.length = 24, p.patch.width = 16, p.patch.height = 8, p.cut.length = 8, p.cut.depth = 3;
    p.mesh.element_size = element_size, p.mesh.grading = grading;
    p.tissue.poisson_ratio = nu;
    if (nu > 0.48) p.tissue.formulation = TissueFormulation::mean_dilatation;
    const PatchMesh mesh = make_patch_mesh(p);
    const PatchSystem system(mesh, p, MPI_COMM_WORLD);
    GridSolver solver(mesh, system);
    const Release release = make_release(mesh, p);
    solver.set_release(release);
    solver.set_loads(system.load(p.skin));
    solver.solve({{0, release.released.back()}});
    return solver.iterations().front();
  };
  for (const double size : {1., 0.6})
    for (const double grading : {1., 1.2, 1.4}) {
      EXPECT_LE(iterations(size, grading, 0.3), 12) << size << ", " << grading;
      EXPECT_LE(iterations(size, grading, 0.49), 20) << size << ", " << grading;
    }
}

}  // namespace cleft
