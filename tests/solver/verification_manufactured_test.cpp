// The tissue against displacements made up in closed form, on the unit cube: rates of convergence, and
// locking. Shape functions and quadrature are the test's own.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "tests/solver/verification_support.h"
#include "tests/support/even_piece.h"
#include "tests/support/refusal.h"
#include "tests/support/stability_row.h"

namespace cleft {

namespace {

using std::numbers::pi;

/// u_i = a_i sin(pi x_i) cos cos of the other two: every component is an eigenfunction of the Laplacian, with
/// eigenvalue -3 pi^2, and so -div sigma = pi^2 (3 mu a + (lambda + mu) (sum of a)) componentwise.
struct Waves {
  Eigen::Vector3d amplitude;

  Eigen::Vector3d products(const Eigen::Vector3d& x) const {
    const Eigen::Array3d s = (pi * x).array().sin(), c = (pi * x).array().cos();
    return {s[0] * c[1] * c[2], c[0] * s[1] * c[2], c[0] * c[1] * s[2]};
  }
  Eigen::Vector3d displacement(const Eigen::Vector3d& x) const { return amplitude.cwiseProduct(products(x)); }
  Eigen::Vector3d body_force(const Eigen::Vector3d& x, double lambda, double mu) const {
    const Eigen::Array3d factor = 3 * mu * amplitude.array() + (lambda + mu) * amplitude.sum();
    return (pi * pi * factor * products(x).array()).matrix();
  }
  Eigen::Matrix3d gradient(const Eigen::Vector3d& x) const {
    const Eigen::Array3d s = (pi * x).array().sin(), c = (pi * x).array().cos();
    Eigen::Matrix3d g;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Eigen::Array3d factor = c;  // cos, but a sine of the component's own axis, then derived by x_j
        factor[i] = s[i];
        factor[j] = i == j ? c[j] : -s[j];
        g(i, j) = amplitude[i] * pi * factor.prod();
      }
    return g;
  }
};

/// A point of a wedge's quadrature: where, its volume, shape functions and their gradients.
struct WedgePoint {
  Eigen::Vector3d x;
  double volume;
  Eigen::Matrix<double, 6, 1> shape;
  Eigen::Matrix<double, 6, 3> gradient;
};

/// Six points in the triangle (degree 4, Dunavant 1985) by three Gauss points along the axis.
void for_each_point(const PatchMesh& mesh, const std::array<int, 6>& wedge,
                    const std::function<void(const WedgePoint&)>& use) {
  Eigen::Matrix<double, 3, 6> corners;
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 3; ++i) corners(i, a) = mesh.points[wedge[a]][i];
  const double triangle[2][2] = {{0.445948490915965, 0.223381589678011 / 2},
                                 {0.091576213509771, 0.109951743655322 / 2}};
  const double line[3][2] = {
      {0.5 - std::sqrt(0.15), 5. / 18}, {0.5, 8. / 18}, {0.5 + std::sqrt(0.15), 5. / 18}};
  for (const auto& [b, area] : triangle)
    for (int turn = 0; turn < 3; ++turn)
      for (const auto& [z, length] : line) {
        Eigen::Vector3d l(b, b, b);
        l[turn] = 1 - 2 * b;
        WedgePoint p;
        Eigen::Matrix<double, 6, 3> local;
        for (int a = 0; a < 6; ++a) {
          const int c = a % 3;
          const double along = a < 3 ? 1 - z : z;
          p.shape[a] = l[c] * along;
          local.row(a) << (c == 1) - (c == 0), (c == 2) - (c == 0), 0;
          local.row(a) *= along;
          local(a, 2) = a < 3 ? -l[c] : l[c];
        }
        const Eigen::Matrix3d jacobian = corners * local;
        p.x = corners * p.shape;
        p.gradient = local * jacobian.inverse();
        p.volume = area * length * jacobian.determinant();
        use(p);
      }
}

struct Errors {
  double l2 = 0, h1 = 0;
};

Errors solve_cube(int n, double nu, TissueFormulation formulation, const Waves& waves) {
  Parameters p = even_piece();
  p.tissue.young_modulus = 1, p.tissue.poisson_ratio = nu, p.tissue.formulation = formulation;
  const double lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu));
  const std::vector<double> lines = even_lines(0, 1, n);
  const PatchMesh mesh = box_mesh(formulation, lines, lines, lines);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);  // the skin lies on the surface, which is prescribed
  const auto place = [&](int node) {
    return Eigen::Vector3d(mesh.points[node].x, mesh.points[node].y, mesh.points[node].z);
  };

  Conditions conditions(system);
  const std::vector<bool> surface = on_surface(mesh);
  for (int node = 0; node < static_cast<int>(mesh.points.size()); ++node)
    for (int i = 0; i < 3 && surface[node]; ++i) conditions.fix(node, i, waves.displacement(place(node))[i]);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  for (const auto& wedge : mesh.wedges)
    for_each_point(mesh, wedge, [&](const WedgePoint& at) {
      const Eigen::Vector3d force = at.volume * waves.body_force(at.x, lambda, mu);
      for (int a = 0; a < 6; ++a)
        for (int i = 0; i < 3; ++i) load[system.unknown(wedge[a], i)] += at.shape[a] * force[i];
    });
  const Eigen::VectorXd solution = conditions.solve(load);

  Errors squares;
  for (const auto& wedge : mesh.wedges) {
    Eigen::Matrix<double, 3, 6> u;
    for (int a = 0; a < 6; ++a)
      for (int i = 0; i < 3; ++i) u(i, a) = solution[system.unknown(wedge[a], i)];
    for_each_point(mesh, wedge, [&](const WedgePoint& at) {
      squares.l2 += at.volume * (u * at.shape - waves.displacement(at.x)).squaredNorm();
      squares.h1 += at.volume * (u * at.gradient - waves.gradient(at.x)).squaredNorm();
    });
  }
  return {std::sqrt(squares.l2), std::sqrt(squares.h1)};
}

const Waves swelling = {{1, 1, 1}}, isochoric = {{1, 1, -2}};

}  // namespace

TEST(Manufactured, ErrorsFallWithTheSquareOfTheElementSize) {
  for (const TissueFormulation formulation :
       {TissueFormulation::displacement, TissueFormulation::mean_dilatation}) {
    const Errors coarse = solve_cube(4, 0.3, formulation, swelling);
    const Errors fine = solve_cube(8, 0.3, formulation, swelling);
    EXPECT_GT(std::log2(coarse.l2 / fine.l2), 1.95) << static_cast<int>(formulation);
    EXPECT_GT(std::log2(coarse.h1 / fine.h1), 0.98) << static_cast<int>(formulation);
    // A program of its own (sums over 28 points a wedge) found these for plain displacements, on stripes and
    // on the chess board; the quadrature here errs by 1e-4. Mean dilatation is another element: near by, not
    // equal.
    const bool plain = formulation == TissueFormulation::displacement;
    const double l2 = plain ? 0.021627 : 0.021071, h1 = plain ? 0.579199 : 0.573417;
    EXPECT_NEAR(fine.l2, l2, (plain ? 1e-3 : 0.05) * l2) << static_cast<int>(formulation);
    EXPECT_NEAR(fine.h1, h1, (plain ? 1e-3 : 0.01) * h1) << static_cast<int>(formulation);
  }
}

TEST(Manufactured, FinerMeshesKeepTheRate) {
  const Errors coarse = solve_cube(6, 0.3, TissueFormulation::displacement, swelling);
  const Errors fine = solve_cube(12, 0.3, TissueFormulation::displacement, swelling);
  EXPECT_GT(std::log2(coarse.l2 / fine.l2), 1.95);
  EXPECT_GT(std::log2(coarse.h1 / fine.h1), 0.98);
}

TEST(Manufactured, MeanDilatationDoesNotLock) {
  const auto errors = [](int n, double nu, TissueFormulation formulation) {
    return solve_cube(n, nu, formulation, isochoric).l2;
  };
  const double coarse = errors(4, 0.499, TissueFormulation::mean_dilatation),
               fine = errors(8, 0.499, TissueFormulation::mean_dilatation);
  // On meshes as coarse as these, the rate at nu = 0.3 is 1.91: no less here. (On stripes it is 1.62, and the
  // errors are half as large again at 0.4999.)
  EXPECT_GT(std::log2(coarse / fine), 1.9);
  // The answer does not depend on nu, and so the errors do not either.
  EXPECT_NEAR(errors(8, 0.4999, TissueFormulation::mean_dilatation) / fine, 1, 0.01);
  // Without it the elements are far too stiff, and refining them once hardly helps; less so at 0.49, which is
  // still allowed.
  const double locked[] = {errors(8, 0.49, TissueFormulation::displacement),
                           errors(8, 0.499, TissueFormulation::displacement),
                           errors(8, 0.4999, TissueFormulation::displacement)};
  EXPECT_LT(locked[0], locked[1]);
  EXPECT_GT(locked[2], 3 * fine);
  EXPECT_GT(locked[1], 3 * fine);
  EXPECT_LT(std::log2(errors(4, 0.499, TissueFormulation::displacement) / locked[1]), 1);
  Parameters p = even_piece();
  p.tissue.poisson_ratio = 0.491;
  record_limit({.method = "linear wedges, displacement formulation",
                .limit = "nearly incompressible tissue: Poisson's ratio above 0.49",
                .shown = "error against the exact isochoric field at 0.49, 0.499, 0.4999: " +
                         rounded(locked[0] / fine) + ", " + rounded(locked[1] / fine) + ", " +
                         rounded(locked[2] / fine) + " times that of mean dilatation",
                .noticed = "refused: " + quoted(refusal_of(p), "tissue.poisson_ratio"),
                .then = "`mean-dilatation` keeps its error at 0.4999 to within " +
                        rounded(100 * (errors(8, 0.4999, TissueFormulation::mean_dilatation) / fine - 1)) +
                        " % of that at 0.499"});
}

}  // namespace cleft
