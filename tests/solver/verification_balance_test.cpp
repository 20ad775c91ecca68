// Every frame of a cut: balance of the springs' forces, and symmetry.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>

#include "solver/direct_solver.h"
#include "tests/solver/small_patch.h"
#include "tests/solver/verification_support.h"

namespace cleft {

namespace {

struct Solved {
  explicit Solved(const Parameters& parameters)
      : p(parameters), mesh(make_patch_mesh(p)), system(mesh, p, MPI_COMM_WORLD) {
    DirectSolver solver(mesh, system);
    solver.factorize();
    const Release release = make_release(mesh, p);
    solver.set_release(release);
    solver.set_loads(system.load(p.skin));
    std::vector<FrameSolver::Column> columns;
    for (const int open : release.released) columns.push_back({0, open});
    frames = solver.solve(columns);
  }

  Vec3 displacement(Eigen::Index frame, int node) const {
    Vec3 u;
    for (int axis = 0; axis < 3; ++axis) u[axis] = frames(system.unknown(node, axis), frame);
    return u;
  }

  Parameters p;
  PatchMesh mesh;
  PatchSystem system;
  Block frames;
};

/// Force of springs and their moment about the origin, and the integral of |force| and of |force| times
/// reach.
struct Pull {
  Vec3 force, moment;
  double size = 0, leverage = 0;

  void add(double area, const Vec3& at, const Vec3& f) {
    force += area * f;
    moment += area * cross(at, f);
    size += area * norm(f);
    leverage += area * norm(at) * norm(f);
  }
};

/// Integrates the springs' pull by rules of the test's own: middles of a triangle's edges, exact for products
/// of two linear functions, and two by two Gauss points, exact for products of two bilinear ones on
/// rectangles.
Pull pull_of_springs(const Solved& s, Eigen::Index frame) {
  Pull pull;
  for (const auto& t : s.mesh.bottom) {
    const Vec3 at[3] = {s.mesh.points[t[0]], s.mesh.points[t[1]], s.mesh.points[t[2]]};
    const double area = norm(cross(at[1] - at[0], at[2] - at[0])) / 2;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      pull.add(area / 3, 0.5 * (at[i] + at[j]),
               s.p.foundation.stiffness / 2 * (s.displacement(frame, t[i]) + s.displacement(frame, t[j])));
    }
  }
  const double gauss[] = {0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)};
  for (const auto& q : s.mesh.sides)
    for (const double x : gauss)
      for (const double y : gauss) {
        const double shape[] = {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
        const double by_x[] = {y - 1, 1 - y, y, -y}, by_y[] = {x - 1, -x, x, 1 - x};
        Vec3 at, u, along_x, along_y;
        for (int i = 0; i < 4; ++i) {
          const Vec3& corner = s.mesh.points[q[i]];
          at += shape[i] * corner, along_x += by_x[i] * corner, along_y += by_y[i] * corner;
          u += shape[i] * s.displacement(frame, q[i]);
        }
        pull.add(norm(cross(along_x, along_y)) / 4, at, s.p.foundation.side_stiffness * u);
      }
  return pull;
}

}  // namespace

// Rounding of K's factors: 1e-16 times a condition number of about 1e4, and sums of some hundred terms.
constexpr double rounding = 1e-10;

TEST(Balance, SpringsBearNoForceAndNoMomentInAnyFrame) {
  for (const double tilt : {0., 25.})
    for (const TissueFormulation formulation :
         {TissueFormulation::displacement, TissueFormulation::mean_dilatation}) {
      Parameters p = small_patch();
      p.cut.tilt = tilt, p.tissue.formulation = formulation;
      p.skin.prestress.uv = 0.013;
      p.foundation.stiffness = 0.007, p.foundation.side_stiffness = 0.002;
      const Solved s(p);
      ASSERT_GT(s.frames.cols(), 4);
      for (Eigen::Index frame = 0; frame < s.frames.cols(); ++frame) {
        const Pull pull = pull_of_springs(s, frame);
        ASSERT_GT(pull.size, 1e-3);
        EXPECT_LT(norm(pull.force), rounding * pull.size);
        EXPECT_LT(norm(pull.moment), rounding * pull.leverage);
      }
    }
}

TEST(Balance, StraightCutStaysSymmetric) {
  for (const bool own_stiffness : {false, true}) {
    Parameters p = small_patch();
    p.skin.initial_stress_stiffness = own_stiffness;
    const Solved s(p);
    std::map<std::array<long, 4>, int> node_at;  // place, and the side of a doubled node
    std::vector<int> side(s.mesh.points.size(), 0);
    for (const NodePair& pair : s.mesh.pairs) side[pair.left] = -1, side[pair.right] = 1;
    const auto key = [&](const Vec3& at, long on_side) {
      return std::array{std::lround(at.x * 1e6), std::lround(at.y * 1e6), std::lround(at.z * 1e6), on_side};
    };
    const int nodes = static_cast<int>(s.mesh.points.size());
    for (int n = 0; n < nodes; ++n) node_at[key(s.mesh.points[n], side[n])] = n;
    ASSERT_EQ(node_at.size(), s.mesh.points.size());
    for (Eigen::Index frame = 0; frame < s.frames.cols(); ++frame) {
      double difference = 0, largest = 0;
      for (int n = 0; n < nodes; ++n) {
        const Vec3& at = s.mesh.points[n];
        const Vec3 here = s.displacement(frame, n);
        const Vec3 there = s.displacement(frame, node_at.at(key({at.x, -at.y, at.z}, -side[n])));
        difference = std::max(difference, norm(here - Vec3{there.x, -there.y, there.z}));
        largest = std::max(largest, norm(here));
      }
      EXPECT_LT(difference, rounding * largest);
    }
  }
}

}  // namespace cleft
