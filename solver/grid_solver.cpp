#include "solver/grid_solver.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "base/error.h"
#include "solver/iterative_solver.h"
#include "solver/multigrid/multigrid.h"
#include "solver/spectrum.h"

namespace cleft {

namespace {

constexpr int most_rounds = 500;  // of conjugate gradients

void told_as_indefinite(const PatchSystem& system, const std::function<void()>& work) {
  try {
    work();
  } catch (const IndefiniteLevel& e) {
    fail_indefinite(system, e.what());
  }
}

/// The power of two next below a load's norm. Divided by it, a load of any size keeps its digits in single
/// precision, and all its bits.
double unit_of(double norm) {
  return checked_norm(norm) > 1 / largest_norm ? std::ldexp(1, std::ilogb(norm)) : 1;
}

/// Lines of the grid: along each axis, where they are by the mean length of the elements between them.
std::array<std::vector<double>, 3> lines_of(const PatchMesh& mesh) {
  const auto& size = mesh.grid;
  std::array<std::vector<double>, 3> places;
  const std::array<int, 3> step = {1, size[0], size[0] * size[1]};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> length(size[axis], 0);  // of the elements after each line, summed
    for (int n = 0; n < size[0] * size[1] * size[2]; ++n)
      if (const int line = n / step[axis] % size[axis]; line + 1 < size[axis])
        length[line] += norm(mesh.points[n + step[axis]] - mesh.points[n]);
    const double count = static_cast<double>(size[0]) * size[1] * size[2] / size[axis];
    places[axis] = {0};
    for (int line = 0; line + 1 < size[axis]; ++line)
      places[axis].push_back(places[axis].back() + length[line] / count);
  }
  return places;
}

DoubledGrid grid_of(const PatchMesh& mesh) {
  std::vector<DoubledGrid::Pair> pairs;
  for (const NodePair& pair : mesh.pairs) pairs.push_back({pair.left, pair.right});
  return {lines_of(mesh), std::move(pairs), mesh.wedges};
}

int owner_of(const PatchSystem& system, int node) {
  const std::vector<int>& offsets = system.offsets();
  return static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), system.unknown(node, 0)) -
                          offsets.begin()) -
         1;
}

}  // namespace

/// The finest level, and where its unknowns are by column of Epetra's matrix. Copies of other ranks' unknowns
/// are in any order there.
struct FinestOfGrid {
  Level level;
  std::vector<int> unknown_of;  // by local column of K: three times the local node, plus the axis

  FinestOfGrid(const PatchMesh& mesh, const PatchSystem& system, const DoubledGrid& grid) {
    level.lines = grid.finest();
    level.owned = system.owned() / 3;
    const Epetra_CrsMatrix& k = system.stiffness();
    std::vector<int> node_of(static_cast<std::size_t>(system.size()) / 3);  // by a third of its first unknown
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n) {
      CLEFT_CHECK(system.unknown(n, 0) % 3, ==, 0);
      node_of[system.unknown(n, 0) / 3] = n;
    }
    for (int n = 0; n < level.owned; ++n) level.numbers.push_back(node_of[system.first() / 3 + n]);
    std::unordered_map<int, int> copies;  // local numbers of other ranks' nodes
    for (int c = 0; c < k.NumMyCols(); ++c) {
      const int unknown = k.GCID(c);
      int node = system.row(unknown) / 3;
      if (system.row(unknown) < 0) {
        const auto [found, is_new] = copies.try_emplace(unknown / 3, level.local());
        if (is_new) level.numbers.push_back(node_of[unknown / 3]);
        node = found->second;
      }
      unknown_of.push_back(3 * node + unknown % 3);
    }
    add_rows(k);
  }

 private:
  void add_rows(const Epetra_CrsMatrix& k) {
    NodeMatrix& matrix = level.matrix;
    matrix.column.reserve(static_cast<std::size_t>(k.NumMyNonzeros()) / 9);
    matrix.value.reserve(static_cast<std::size_t>(k.NumMyNonzeros()));
    std::vector<std::int64_t> at(static_cast<std::size_t>(level.local()),
                                 -1);  // block of a column, in this row
    std::vector<int> first;            // columns of a node's first row, which its others have too
    for (int node = 0; node < level.owned; ++node) {
      const auto begin = static_cast<std::int64_t>(matrix.column.size());
      for (int axis = 0; axis < 3; ++axis) {
        int count = 0, *columns = nullptr;
        double* values = nullptr;
        k.ExtractMyRowView(3 * node + axis, count, values, columns);
        if (axis == 0) first.assign(columns, columns + count);
        CLEFT_CHECK(std::equal(first.begin(), first.end(), columns, columns + count), ==, true);
        for (int i = 0; i < count; ++i) {
          const int unknown = unknown_of[columns[i]];
          std::int64_t& block = at[unknown / 3];
          if (block < begin) {
            block = static_cast<std::int64_t>(matrix.column.size());
            matrix.column.push_back(unknown / 3);
            matrix.value.resize(matrix.value.size() + 9, 0);
          }
          matrix.value[9 * block + 3 * axis + unknown % 3] = static_cast<float>(values[i]);
        }
      }
      matrix.start.push_back(static_cast<std::int64_t>(matrix.column.size()));
    }
  }
};

struct GridSolver::Parts {
  Parts(const PatchMesh& m, const PatchSystem& s)
      : mesh(m),
        system(s),
        grid(grid_of(m)),
        finest(m, s, grid),
        multigrid(grid, std::move(finest.level), s.communicator(),
                  [&s](int node) { return owner_of(s, node); }) {}

  const PatchMesh& mesh;
  const PatchSystem& system;
  const DoubledGrid grid;
  FinestOfGrid finest;  // its level belongs to the multigrid
  Multigrid multigrid;
  Block loads;
  std::vector<Eigen::VectorXd> last;  // solution of every load, to start from
  std::vector<int> iterations;

  using Sums = std::array<double, most_lanes>;
  using Vector = std::vector<double>;

  /// Replaces tied unknowns by their mean.
  template <class T>
  void project(std::vector<T>& x, int lanes) {
    Level& level = multigrid.finest();
    level.cut_halo.update(x.data(), 3 * lanes);
    for (const Ties::Place& place : level.ties.places)
      for (int lane = 0; lane < lanes; ++lane)
        for (std::size_t group = 0; group < place.nodes.size(); ++group)
          for (int axis = 0; axis < 3; ++axis) {
            T sum = 0;
            int count = 0;
            const auto each = [&](auto&& visit) {
              for (std::size_t c = 0; c < place.nodes.size(); ++c)
                if (place.first[lane][c] == static_cast<int>(group))
                  visit(x[(std::size_t{3} * place.nodes[c] + axis) * lanes + lane]);
            };
            each([&](const T& value) { sum += value, ++count; });
            if (count > 1) each([&](T& value) { value = sum / static_cast<T>(count); });
          }
  }

  Sums dot(const LaneTable& table, const Vector& a, const Vector& b) const {
    Sums sums{};
    table.dot(system.owned(), a.data(), b.data(), sums.data());
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), table.lanes, MPI_DOUBLE, MPI_SUM, system.communicator());
    return sums;
  }

  Sums dot(const LaneTable& table, const std::vector<float>& a, const Vector& b) const {
    Sums sums{};
    table.dot_mixed(system.owned(), a.data(), b.data(), sums.data());
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), table.lanes, MPI_DOUBLE, MPI_SUM, system.communicator());
    return sums;
  }

  /// y = P K x; x gets copies of other ranks' values.
  void multiply(const LaneTable& table, Vector& x, Vector& y) {
    multigrid.finest().halo.update(x.data(), 3 * table.lanes);
    const Epetra_CrsMatrix& k = system.stiffness();
    std::vector<int> unknowns;
    for (int row = 0; row < k.NumMyRows(); row += 3) {
      int count = 0, *columns = nullptr;
      std::array<double*, 3> values{};
      for (int axis = 0; axis < 3; ++axis) k.ExtractMyRowView(row + axis, count, values[axis], columns);
      unknowns.resize(count);
      for (int i = 0; i < count; ++i) unknowns[i] = finest.unknown_of[columns[i]];
      table.multiply_node(count, unknowns.data(), values.data(), x.data(),
                          y.data() + static_cast<std::ptrdiff_t>(row) * table.lanes);
    }
    project(y, table.lanes);
  }

  /// Columns of different or equal loads, from x, which becomes their solutions; 1 or most_lanes of them.
  void solve(const std::vector<Column>& columns, std::vector<int>& counts, Vector& x) {
    const auto lanes = static_cast<int>(columns.size());
    const LaneTable& table = lane_table(lanes);
    std::vector<int> open;
    open.reserve(most_lanes);
    for (const Column& column : columns) open.push_back(column.open);
    told_as_indefinite(system, [&] { multigrid.set_lanes(open); });
    Level& level = multigrid.finest();
    const std::size_t size = std::size_t{3} * level.local() * lanes;
    Vector r(size, 0), p(size, 0), q(size, 0);
    for (int lane = 0; lane < lanes; ++lane)
      for (int u = 0; columns[lane].load >= 0 && u < system.owned(); ++u)
        r[static_cast<std::size_t>(u) * lanes + lane] = loads(u, columns[lane].load);
    project(r, lanes);
    Sums enough = dot(table, r, r), unit{}, rz{}, alpha{}, beta{};
    for (int lane = 0; lane < lanes; ++lane) {
      const double norm = std::sqrt(enough[lane]);
      unit[lane] = unit_of(norm), enough[lane] = columns[lane].residual * norm / unit[lane];
    }
    const auto scale = [&](Vector& values, bool back) {
      for (std::size_t u = 0; u < static_cast<std::size_t>(system.owned()); ++u)
        for (int lane = 0; lane < lanes; ++lane)
          values[u * lanes + lane] *= back ? unit[lane] : 1 / unit[lane];
    };
    scale(r, false), scale(x, false);
    project(x, lanes);
    multiply(table, x, q);
    Sums minus_one;
    minus_one.fill(-1);
    table.add(system.owned(), minus_one.data(), q.data(), r.data());
    counts.assign(lanes, 0);
    for (int n = 0;; ++n) {
      const Sums norms = dot(table, r, r);
      std::array<bool, most_lanes> active{};
      bool any = false;
      for (int lane = 0; lane < lanes; ++lane) {
        active[lane] = !(std::sqrt(norms[lane]) <= enough[lane]);
        any = any || active[lane];
      }
      if (!any) break;
      if (n == most_rounds)
        throw SolveError(
            "no solution after " + std::to_string(n) +
            " iterations: the springs are too weak, the moduli of skin and tissue differ too much, or "
            "tissue.poisson_ratio is too near 0.5; change them, or use --method direct");
      for (std::size_t u = 0; u < static_cast<std::size_t>(system.owned()); ++u)
        for (int lane = 0; lane < lanes; ++lane)
          level.b[u * lanes + lane] = active[lane] ? static_cast<float>(r[u * lanes + lane]) : 0.F;
      multigrid.apply();
      std::vector<float>& z = level.x;
      project(z, lanes);
      const Sums zq = dot(table, z, q), previous = rz;
      rz = dot(table, z, r);
      // With the residual's change, because single precision makes the preconditioner differ from a linear
      // one.
      for (int lane = 0; lane < lanes; ++lane)
        beta[lane] = n == 0 || !active[lane] ? 0 : -alpha[lane] * zq[lane] / previous[lane];
      table.follow(system.owned(), beta.data(), z.data(), p.data());
      multiply(table, p, q);
      const Sums energy = dot(table, p, q);
      Sums minus{};
      for (int lane = 0; lane < lanes; ++lane) {
        alpha[lane] = 0;
        if (!active[lane]) continue;
        if (!(energy[lane] > 0) || !(rz[lane] > 0))
          fail_indefinite(system, "by " + std::to_string(n) + " iterations");
        alpha[lane] = rz[lane] / energy[lane];
        minus[lane] = -alpha[lane];
        ++counts[lane];
      }
      table.add(system.owned(), alpha.data(), p.data(), x.data());
      table.add(system.owned(), minus.data(), q.data(), r.data());
    }
    scale(x, true);
  }

  /// Some columns, each from the last solution of its load.
  void solve_some(const std::vector<Column>& columns, const std::vector<std::size_t>& some, Block& solution,
                  std::vector<int>& counts) {
    const int lanes = some.size() == 1 ? 1 : most_lanes;
    std::vector<Column> block;
    block.reserve(most_lanes);
    for (const std::size_t c : some) block.push_back(columns[c]);
    while (static_cast<int>(block.size()) < lanes) block.push_back({-1, block.back().open, false, 1});
    Vector x(std::size_t{3} * multigrid.finest().local() * lanes, 0);
    for (std::size_t lane = 0; lane < some.size(); ++lane)
      for (int u = 0; u < system.owned(); ++u)
        x[static_cast<std::size_t>(u) * lanes + lane] = last[block[lane].load](u);
    std::vector<int> taken;
    solve(block, taken, x);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      counts[some[lane]] = taken[lane];
      for (int u = 0; u < system.owned(); ++u)
        solution(u, static_cast<Eigen::Index>(some[lane])) = x[static_cast<std::size_t>(u) * lanes + lane];
    }
  }
};

double GridSolver::bytes_needed(const PatchSystem& system) {
  // K in single precision and the coarser levels; the vectors of eight lanes, and their frames.
  return 5. * 1.5 * system.stiffness().NumMyNonzeros() + most_lanes * (8. * 5 + 4. * 4) * system.owned();
}

GridSolver::GridSolver(const PatchMesh& mesh, const PatchSystem& system)
    : parts_(std::make_unique<Parts>(mesh, system)) {}

GridSolver::~GridSolver() = default;

void GridSolver::set_release(const Release& release) {
  std::vector<int> opens_after(release.order.size());
  for (std::size_t i = 0; i < release.order.size(); ++i) opens_after[release.order[i]] = static_cast<int>(i);
  told_as_indefinite(parts_->system, [&] { parts_->multigrid.set_release(std::move(opens_after)); });
}

void GridSolver::set_loads(Block loads, Together) {
  parts_->last.assign(loads.cols(), Eigen::VectorXd::Zero(loads.rows()));
  parts_->loads = std::move(loads);
}

/// Columns of a load go in the order of their open pairs, as many at a time as there are lanes, whatever the
/// other loads: a solution does not depend on what is solved with it.
Block GridSolver::solve(const std::vector<Column>& columns) {
  refuse_contact(columns);
  std::vector<std::vector<std::size_t>> of_load(parts_->loads.cols());
  for (std::size_t c = 0; c < columns.size(); ++c) of_load[columns[c].load].push_back(c);
  std::size_t rounds = 0;
  for (auto& list : of_load) {
    std::stable_sort(list.begin(), list.end(),
                     [&](std::size_t a, std::size_t b) { return columns[a].open < columns[b].open; });
    rounds = std::max(rounds, (list.size() + most_lanes - 1) / most_lanes);
  }
  Block solution(parts_->loads.rows(), static_cast<Eigen::Index>(columns.size()));
  std::vector<int> counts(columns.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<std::size_t> ready;
    for (const auto& list : of_load)
      for (std::size_t i = round * most_lanes; i < std::min(list.size(), (round + 1) * most_lanes); ++i)
        ready.push_back(list[i]);
    for (std::size_t first = 0; first < ready.size(); first += most_lanes)
      parts_->solve_some(
          columns,
          {ready.begin() + static_cast<std::ptrdiff_t>(first),
           ready.begin() + static_cast<std::ptrdiff_t>(std::min(ready.size(), first + most_lanes))},
          solution, counts);
    for (std::size_t load = 0; load < of_load.size(); ++load)
      if (const std::size_t end = std::min(of_load[load].size(), (round + 1) * most_lanes);
          end > round * most_lanes)
        parts_->last[load] = solution.col(static_cast<Eigen::Index>(of_load[load][end - 1]));
  }
  parts_->iterations.insert(parts_->iterations.end(), counts.begin(), counts.end());
  return solution;
}

std::vector<int> GridSolver::iterations() const { return parts_->iterations; }

}  // namespace cleft
