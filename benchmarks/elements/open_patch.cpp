#include "benchmarks/elements/open_patch.h"

#include <dmumps_c.h>
#include <mpi.h>

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/stopwatch.h"
#include "benchmarks/elements/element.h"
#include "benchmarks/elements/patch_nodes.h"
#include "solver/patch_mesh.h"

namespace cleft::elements {

namespace {

std::vector<Element> elements_of(const PatchNodes& nodes) {
  std::vector<Element> elements;
  const CutLines& lines = nodes.lines;
  for (int k = 0; k + 1 < static_cast<int>(lines.w.size()); ++k)
    for (int j = 0; j + 1 < static_cast<int>(lines.v.size()); ++j)
      for (int i = 0; i + 1 < static_cast<int>(lines.u.size()); ++i) {
        using Corner = std::array<int, 2>;
        const Corner a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
        using Triangle = std::array<Corner, 3>;
        const bool rises = diagonal_rises(false, i - lines.first, j - lines.plane);
        for (const Triangle& triangle : rises ? std::array{Triangle{a, b, c}, Triangle{a, c, d}}
                                              : std::array{Triangle{a, b, d}, Triangle{b, c, d}}) {
          std::array<Place, 6> corners;
          for (int n = 0; n < 6; ++n)
            corners[n] = {2 * triangle[n % 3][0], 2 * triangle[n % 3][1], 2 * (n < 3 ? k + 1 : k)};
          elements.emplace_back(nodes, corners, j == lines.plane ? 1 : -1);
        }
      }
  return elements;
}

/// The lower triangle of K, in blocks of three unknowns.
class Stiffness {
 public:
  Stiffness(int nodes, const std::vector<Element>& elements) : below_(nodes), first_(nodes + 1, 0) {
    for (const Element& element : elements)
      for (const int a : element.nodes())
        for (const int b : element.nodes())
          if (b >= a) below_[a].push_back(b);
    for (int n = 0; n < nodes; ++n) {
      auto& list = below_[n];
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      first_[n + 1] = first_[n] + 9 * static_cast<int>(list.size()) - 3;
    }
    values_.assign(first_.back(), 0);
  }

  /// `matrix`: axis by axis, of all nodes.
  void add(const std::vector<int>& nodes, const Eigen::MatrixXd& matrix) {
    const auto count = static_cast<Eigen::Index>(nodes.size());
    for (Eigen::Index a = 0; a < count; ++a)
      for (Eigen::Index b = 0; b < count; ++b) {
        if (nodes[b] < nodes[a]) continue;
        const auto& list = below_[nodes[a]];
        const int place =
            static_cast<int>(std::lower_bound(list.begin(), list.end(), nodes[b]) - list.begin());
        for (int i = 0; i < 3; ++i)
          for (int j = place == 0 ? i : 0; j < 3; ++j)
            values_[column(nodes[a], i) + 3 * place + j - i] += matrix(j * count + b, i * count + a);
      }
  }

  struct Entries {
    std::vector<int> row, column;  // from 1
    std::vector<double> value;
  };
  Entries entries() && {
    Entries e;
    e.row.reserve(values_.size()), e.column.reserve(values_.size());
    for (int n = 0; n < static_cast<int>(below_.size()); ++n)
      for (int i = 0; i < 3; ++i)
        for (const int m : below_[n])
          for (int j = m == n ? i : 0; j < 3; ++j)
            e.row.push_back(3 * m + j + 1), e.column.push_back(3 * n + i + 1);
    e.value = std::move(values_);
    return e;
  }

 private:
  /// Where the column of an unknown begins; the one of axis i has 3 size - i entries.
  int column(int node, int axis) const {
    const int height = 3 * static_cast<int>(below_[node].size());
    return first_[node] + axis * height - axis * (axis - 1) / 2;
  }

  std::vector<std::vector<int>> below_;  // by node: itself and its neighbours of greater number
  std::vector<int> first_;
  std::vector<double> values_;
};

/// Solves for the displacements in place of the forces, by MUMPS in the order of the unknowns, as `cleft
/// solve` does.
void solve(Stiffness::Entries& k, Eigen::VectorXd& forces) {
  DMUMPS_STRUC_C mumps{};
  const auto run = [&](int job) {
    mumps.job = job;
    dmumps_c(&mumps);
    if (mumps.infog[0] < 0) throw std::runtime_error("MUMPS failed with " + std::to_string(mumps.infog[0]));
  };
  mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_WORLD));
  mumps.par = mumps.sym = 1;
  run(-1);
  for (const int output : {0, 1, 2, 3}) mumps.icntl[output] = 0;
  mumps.icntl[6] = 1;  // the order is given
  std::vector<int> order(static_cast<std::size_t>(forces.size()));
  std::iota(order.begin(), order.end(), 1);
  mumps.n = static_cast<MUMPS_INT>(forces.size()), mumps.nnz = static_cast<MUMPS_INT8>(k.value.size());
  mumps.irn = k.row.data(), mumps.jcn = k.column.data(), mumps.a = k.value.data();
  mumps.perm_in = order.data(), mumps.rhs = forces.data();
  run(6);
  mumps.perm_in = nullptr;
  run(-2);
}

}  // namespace

Opened open_patch(const Parameters& p, const CutLines& lines, Kind kind) {
  Opened opened;
  const double begin = processor_seconds();
  const PatchNodes nodes(lines, kind);
  const std::vector<Element> elements = elements_of(nodes);
  Stiffness stiffness(nodes.count(), elements);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * nodes.count());
  std::vector<Vec3> points(nodes.count());
  for (const Element& element : elements) {
    stiffness.add(element.nodes(), element.stiffness(p));
    const Eigen::VectorXd released = element.released();
    for (std::size_t n = 0; n < element.nodes().size(); ++n)
      forces[3 * element.nodes()[n] + 1] +=
          p.skin.thickness * p.skin.prestress.vv * released[static_cast<Eigen::Index>(n)];
  }
  for (const Element& element : elements) {
    for (std::size_t n = 0; n < element.points().size(); ++n)
      points[element.nodes()[n]] = element.points()[n];
  }
  Stiffness::Entries entries = std::move(stiffness).entries();
  const double assembled = processor_seconds();
  opened.unknowns = static_cast<int>(forces.size());
  solve(entries, forces);
  opened.assembly = assembled - begin, opened.solution = processor_seconds() - assembled;
  const int step = kind == Kind::linear || kind == Kind::enriched ? 2 : 1;
  for (int i = 2 * lines.first + step; i < 2 * lines.last; i += step) {
    const int left = nodes.at({i, 2 * lines.plane, 0}, -1), right = nodes.at({i, 2 * lines.plane, 0}, 1);
    opened.along.push_back(points[left].x + p.cut.length / 2);
    opened.opening.push_back((forces.segment<3>(3 * right) - forces.segment<3>(3 * left)).norm());
  }
  return opened;
}

}  // namespace cleft::elements
