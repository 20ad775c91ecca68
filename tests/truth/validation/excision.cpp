// A round excision, by the solver's own elements, laws, factor and Newton's method, on a mesh of its own:
//   cleft-truth-excision CASE.toml RADIUS DEPTH RINGS OUT.csv
// The patch is a disc of the diameter patch.length and the height patch.height, on springs below only, whose
// surroundings pull at its edge (skin.edges = "held"). Around the circle of RADIUS mm nodes are doubled, from
// the skin down to DEPTH mm (patch.height: right through), and all open at once. RINGS elements lie between
// the middle and the circle; a layer is mesh.element_size high. OUT.csv has the nodes of the skin: part
// (piece, piece_edge, hole_edge, skin), position and displacement, mm.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <numbers>
#include <numeric>

#include "params/study.h"
#include "solver/block_rows.h"
#include "solver/direct_solver.h"
#include "solver/mpi_session.h"
#include "solver/newton.h"

using namespace cleft;

namespace {

/// A square of nodes whose rings (squares around the middle) are laid onto circles, layer by layer.
struct Disc {
  Disc(const Parameters& p, double radius, double depth, int rings) : inner(rings) {
    const double outer = p.patch.length / 2, growth = p.mesh.grading;
    for (int m = 0; m <= inner; ++m) radii.push_back(radius * m / inner);
    double step = radius / inner;
    while (radii.back() + 1.5 * step * growth < outer) radii.push_back(radii.back() + (step *= growth));
    radii.push_back(outer);
    n = static_cast<int>(radii.size()) - 1, width = 2 * n + 1;
    layers = std::max(1, static_cast<int>(std::ceil(p.patch.height / p.mesh.element_size - 1e-9)));
    height = p.patch.height / layers;
    while (cut_layers <= layers && cut_layers * height <= depth + 1e-9) ++cut_layers;
    for (int k = 0; k <= layers; ++k)
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i) mesh.points.push_back(place(i, j, k));
    mesh.grid = {width, width, layers + 1};
    double_the_circle();
    for (std::size_t node = 0; node < mesh.points.size(); ++node)
      mesh.skin_above.push_back(static_cast<int>(node));  // only compliances need it
    for (int j = -n; j < n; ++j)
      for (int i = -n; i < n; ++i) add_square(i, j);
  }

  static int ring(int i, int j) { return std::max(std::abs(i), std::abs(j)); }
  int node(int i, int j, int k) const { return (k * width + j + n) * width + i + n; }

  Vec3 place(int i, int j, int k) const {
    const int m = ring(i, j);
    if (m == 0) return {0, 0, -k * height};
    const double quarter = std::numbers::pi / 4;
    // Along each side of the square the angle grows evenly, by a right angle.
    const double angle = i == m    ? quarter * j / m
                         : j == m  ? quarter * (2 - static_cast<double>(i) / m)
                         : i == -m ? quarter * (4 - static_cast<double>(j) / m)
                                   : quarter * (6 + static_cast<double>(i) / m);
    return {radii[m] * std::cos(angle), radii[m] * std::sin(angle), -k * height};
  }

  /// Pairs: left inside, right outside.
  void double_the_circle() {
    outside.assign(mesh.points.size(), -1);
    for (int j = -inner; j <= inner; ++j)
      for (int i = -inner; i <= inner; ++i) {
        if (ring(i, j) != inner) continue;
        const Vec3 at = place(i, j, 0);
        for (int k = 0; k < cut_layers; ++k) {
          NodePair pair;
          pair.left = node(i, j, k), pair.right = static_cast<int>(mesh.points.size());
          pair.normal = {at.x / radii[inner], at.y / radii[inner], 0};
          pair.depth = k * height;
          outside[pair.left] = pair.right;
          mesh.points.push_back(mesh.points[pair.left]);
          mesh.pairs.push_back(pair);
        }
      }
  }

  /// Two columns of wedges. The diagonal points away from the middle: where a ring turns a corner of the
  /// square it runs straight on, so that the other diagonal would flatten a triangle.
  void add_square(int i, int j) {
    const bool is_outside = std::max(ring(i, j), ring(i + 1, j + 1)) > inner;
    const std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
    const bool rising = (i >= 0) == (j >= 0);
    for (const auto& chosen : rising ? std::array<std::array<int, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}}
                                     : std::array<std::array<int, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}}) {
      const auto at = [&](int k) {
        std::array<int, 3> nodes{};
        for (int c = 0; c < 3; ++c) {
          nodes[c] = node(corners[chosen[c]][0], corners[chosen[c]][1], k);
          if (is_outside && outside[nodes[c]] >= 0) nodes[c] = outside[nodes[c]];
        }
        return nodes;
      };
      mesh.skin.push_back(at(0));
      mesh.bottom.push_back(at(layers));
      for (int k = 0; k < layers; ++k) {
        const auto above = at(k), below = at(k + 1);
        mesh.wedges.push_back({below[0], below[1], below[2], above[0], above[1], above[2]});
      }
    }
  }

  Release release() const {
    Release all;
    all.order.resize(mesh.pairs.size());
    std::iota(all.order.begin(), all.order.end(), 0);
    all.released = {0, static_cast<int>(mesh.pairs.size())};
    all.position = all.times = {0, 2 * std::numbers::pi * radii[inner]};
    return all;
  }

  const char* part(int node) const {
    if (node >= width * width) return "hole_edge";  // of those of the skin only right nodes
    const int m = ring(node % width - n, node / width - n);
    return m < inner ? "piece" : m == inner ? "piece_edge" : "skin";
  }

  int inner, n = 0, width = 0, layers = 1, cut_layers = 1;
  double height = 0;
  std::vector<double> radii;
  std::vector<int> outside;  // by node: its copy outside of the circle
  PatchMesh mesh;
};

Block displacement_of(const Disc& disc, Parameters p) {
  p.skin.initial_stress_stiffness = p.model == Model::finite;  // K is the tangent at the reference state
  const PatchSystem system(disc.mesh, p, MPI_COMM_WORLD);
  const Release release = disc.release();
  DirectSolver solver(disc.mesh, system);
  solver.factorize();
  solver.set_release(release);
  const Block load = system.load(p.skin);
  std::vector<int> all(static_cast<std::size_t>(system.size()));
  std::iota(all.begin(), all.end(), 0);
  if (p.model == Model::small) return gather_rows(system, solver.solve_once(load, release.released[1]), all);
  const FrameResidual residual(disc.mesh, system);
  FinitePatch patch(system, p);
  NewtonSolver newton(disc.mesh, system, patch, release, solver, residual, load.cwiseAbs().maxCoeff(),
                      p.cut.contact);
  Block u = Block::Zero(system.owned(), 1);
  newton.solve(0, u);
  const NewtonFrame frame = newton.solve(1, u);
  std::fprintf(stderr, "residual %.1e after %zu steps, %d parts of the load\n", frame.residual,
               frame.steps.size(), frame.load_steps);
  return gather_rows(system, u, all);
}

}  // namespace

int main(int argc, char** argv) try {
  const MpiSession mpi(argc, argv);
  if (argc != 6) {
    std::fprintf(stderr, "usage: cleft-truth-excision CASE.toml RADIUS DEPTH RINGS OUT.csv\n");
    return 2;
  }
  const Parameters p = read_case(argv[1], {}).parameters;
  const Disc disc(p, std::atof(argv[2]), std::atof(argv[3]), std::atoi(argv[4]));
  const Block u = displacement_of(disc, p);
  const PatchSystem system(disc.mesh, p, MPI_COMM_WORLD);  // for the numbers of its unknowns
  std::ofstream out(argv[5]);
  out.precision(12);
  out << "part,x,y,dx,dy\n";
  for (std::size_t node = 0; node < disc.mesh.points.size(); ++node) {
    const Vec3& at = disc.mesh.points[node];
    if (at.z != 0) continue;
    const int number = static_cast<int>(node);
    out << disc.part(number) << ',' << at.x << ',' << at.y;
    for (const int axis : {0, 1}) out << ',' << u(system.unknown(number, axis), 0);
    out << '\n';
  }
  return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "cleft-truth-excision: error: %s\n", error.what());
  return 1;
}
