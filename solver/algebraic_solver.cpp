#include "solver/algebraic_solver.h"

#include <Epetra_FECrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <ml_MultiLevelPreconditioner.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "solver/block_rows.h"
#include "solver/cut_nodes.h"
#include "solver/iterative_solver.h"
#include "solver/spectrum.h"

namespace cleft {

namespace {

constexpr int most_iterations = 2000;

/// Translations along u, v, w and rotations about them, at every owned unknown: what the coarse levels must
/// represent.
Block rigid_body_modes(const PatchSystem& system) {
  const Eigen::MatrixX4d places = system.places();
  Block modes = Block::Zero(places.rows(), 6);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const int axis = static_cast<int>(places(i, 3));
    modes(i, axis) = 1;
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    modes(i, 3 + last) = -places(i, next);  // rotation about `last` moves `axis` by -x_next
    modes(i, 3 + next) = places(i, last);
  }
  return modes;
}

}  // namespace

/// A hierarchy for the patch with some of its pairs tied. The matrix keeps its size: rows of tied unknowns
/// are added to those of the first of their group, and become those of the unit matrix.
class Hierarchy {
 public:
  /// `first`: by local column of K, the global unknown that represents it.
  Hierarchy(const PatchSystem& system, const std::vector<int>& stands_for, Block modes)
      : modes_(std::move(modes)), tied_(Copy, system.stiffness().RowMap(), 60) {
    const Epetra_CrsMatrix& k = system.stiffness();
    std::vector<int> columns_of_row;
    for (int row = 0; row < k.NumMyRows(); ++row) {
      int count = 0, *columns = nullptr;
      double* values = nullptr;
      k.ExtractMyRowView(row, count, values, columns);
      columns_of_row.assign(count, 0);
      for (int i = 0; i < count; ++i) columns_of_row[i] = stands_for[columns[i]];
      const int own = k.GRID(row), into = stands_for[k.LCID(own)];
      tied_.InsertGlobalValues(into, count, values, columns_of_row.data());
      if (into == own) continue;
      const double one = 1;
      tied_.InsertGlobalValues(own, 1, &one, &own);
      modes_.row(row).setZero();
    }
    tied_.GlobalAssemble();
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("PDE equations", 3);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", static_cast<int>(modes_.cols()));
    list.set("null space: vectors", modes_.data());
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: threshold", 0.);
    // Prolongators smoother than ML's 4/3, so that iterations hardly grow with the number of unknowns; and no
    // slower to make or to apply.
    list.set("aggregation: damping factor", 1.9);
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", 4);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 2000);
    levels_ = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(tied_, list, true);
  }

  Eigen::VectorXd operator()(Eigen::VectorXd r) const {
    Eigen::VectorXd z(r.size());
    const Epetra_MultiVector in(View, levels_->OperatorDomainMap(), r.data(), static_cast<int>(r.size()), 1);
    Epetra_MultiVector out(View, levels_->OperatorRangeMap(), z.data(), static_cast<int>(z.size()), 1);
    levels_->ApplyInverse(in, out);
    return z;
  }

 private:
  Block modes_;  // ML keeps a pointer
  Epetra_FECrsMatrix tied_;
  std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> levels_;
};

struct AlgebraicSolver::Parts {
  Parts(const PatchMesh& m, const PatchSystem& s)
      : mesh(m), system(s), cut(m, s), modes(rigid_body_modes(s)) {}

  const PatchMesh& mesh;
  const PatchSystem& system;
  CutNodes cut;
  Block modes;
  std::unique_ptr<Hierarchy> multigrid;
  std::vector<int> multigrid_groups;
  int multigrid_open = -1;  // pairs open in the patch that it was made for
  Release release;
  Block loads;
  std::vector<Block> last;  // solution of every load, to start from
  std::vector<int> iterations;

  /// Groups of tied copies: by node of the cut, the first of its group.
  std::vector<int> groups(int open) const {
    std::vector<int> first(cut.nodes.size());
    std::iota(first.begin(), first.end(), 0);
    const std::vector<bool> closed = release.closed(open);
    for (std::size_t p = 0; p < mesh.pairs.size(); ++p)  // a right node is the left one of later pairs only
      if (closed[p]) first[cut.pairs[p][1]] = first[cut.pairs[p][0]];
    return first;
  }

  /// Adds up the entries of every group of tied copies, and gives each copy what `share` makes of the sum,
  /// the group's size and whether the copy is the first.
  template <class Share>
  void collect(const std::vector<int>& first, Eigen::VectorXd& x, const Share& share) const {
    const int begin = system.first(), end = begin + system.owned();
    std::vector<double> sum(3 * cut.nodes.size(), 0);
    std::vector<int> count(cut.nodes.size(), 0);
    const auto each = [&](auto&& visit) {
      for (std::size_t n = 0; n < cut.nodes.size(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
          const int unknown = cut.unknowns[3 * n + axis];
          if (begin <= unknown && unknown < end) visit(static_cast<int>(n), axis, x(unknown - begin));
        }
    };
    each([&](int n, int axis, double value) { sum[3 * first[n] + axis] += value; });
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM,
                  system.communicator());
    for (const int f : first) ++count[f];
    each([&](int n, int axis, double& value) {
      value = share(sum[3 * first[n] + axis], count[first[n]], first[n] == n);
    });
  }

  /// Replaces tied unknowns by their mean.
  void project(const std::vector<int>& first, Eigen::VectorXd& x) const {
    collect(first, x, [](double sum, int count, bool) { return sum / count; });
  }

  Eigen::VectorXd precondition(const std::vector<int>& first, Eigen::VectorXd r) const {
    collect(multigrid_groups, r, [](double sum, int, bool is_first) { return is_first ? sum : 0; });
    Eigen::VectorXd z = (*multigrid)(std::move(r));
    collect(multigrid_groups, z, [](double sum, int, bool) { return sum; });  // the others are 0
    project(first, z);
    return z;
  }

  /// A hierarchy serves the frame it was made for, and those that are closed a little further: they take a
  /// few more iterations for every pair that is open in it alone, so it is never made further open than a
  /// frame.
  void prepare(int open) {
    const std::vector<int>& frames = release.released;
    const int ahead = 1 + frames.back() / 64;
    if (multigrid && open <= multigrid_open && multigrid_open < open + ahead) return;
    const auto beyond = std::lower_bound(frames.begin(), frames.end(), open + ahead);
    multigrid_open = open == 0 ? 0 : std::max(open, *std::prev(beyond));
    multigrid_groups = groups(multigrid_open);
    const Epetra_CrsMatrix& k = system.stiffness();
    std::vector<int> stands_for(k.NumMyCols());
    for (int c = 0; c < k.NumMyCols(); ++c) stands_for[c] = k.GCID(c);
    for (std::size_t n = 0; n < cut.nodes.size(); ++n)
      for (int axis = 0; axis < 3; ++axis)
        if (const int local = k.LCID(cut.unknowns[3 * n + axis]); local >= 0)
          stands_for[local] = cut.unknowns[3 * multigrid_groups[n] + axis];
    multigrid.reset();
    multigrid = std::make_unique<Hierarchy>(system, stands_for, modes);
  }

  /// From x, which is replaced by the solution.
  void solve(const Eigen::VectorXd& load, const Column& column, Eigen::VectorXd& x) {
    prepare(column.open);
    const std::vector<int> first = groups(column.open);
    project(first, x);
    Eigen::VectorXd r = load;
    project(first, r);
    const double enough = column.residual * checked_norm(std::sqrt(dot(system, r, r)));
    Eigen::VectorXd product = system.multiply(x);
    project(first, product);
    r -= product;
    Eigen::VectorXd direction;
    double rz = 0;
    int n = 0;
    for (; !(std::sqrt(dot(system, r, r)) <= enough); ++n) {
      if (n == most_iterations)
        throw SolveError("no solution after " + std::to_string(n) +
                         " iterations: the stiffness is badly conditioned");
      const Eigen::VectorXd z = precondition(first, r);
      const double previous = rz;
      rz = dot(system, r, z);
      if (n == 0)
        direction = z;
      else
        direction = z + rz / previous * direction;
      product = system.multiply(direction);
      project(first, product);
      const double energy = dot(system, direction, product);
      if (!(energy > 0) || !(rz > 0)) fail_indefinite(system, "by " + std::to_string(n) + " iterations");
      x += rz / energy * direction;
      r -= rz / energy * product;
    }
    iterations.push_back(n);
  }
};

double AlgebraicSolver::bytes_needed(const PatchSystem& system) {
  // K once more with its tied pairs, the coarser levels, the blocks and CG's vectors.
  return 12. * 1.5 * system.stiffness().NumMyNonzeros() + 8. * 100 * system.owned();
}

AlgebraicSolver::AlgebraicSolver(const PatchMesh& mesh, const PatchSystem& system)
    : parts_(std::make_unique<Parts>(mesh, system)) {}

AlgebraicSolver::~AlgebraicSolver() = default;

void AlgebraicSolver::set_release(const Release& release) {
  parts_->release = release;
  parts_->multigrid.reset();
}

void AlgebraicSolver::set_loads(Block loads, Together) {
  parts_->last.assign(loads.cols(), Block::Zero(loads.rows(), 1));
  parts_->loads = std::move(loads);
}

Block AlgebraicSolver::solve(const std::vector<Column>& columns) {
  refuse_contact(columns);
  Block solution(parts_->loads.rows(), static_cast<Eigen::Index>(columns.size()));
  std::vector<std::size_t> order(columns.size());  // frame by frame: its loads share a hierarchy
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return columns[a].open < columns[b].open; });
  for (const std::size_t c : order) {
    Eigen::VectorXd x = parts_->last[columns[c].load];
    parts_->solve(parts_->loads.col(columns[c].load), columns[c], x);
    parts_->last[columns[c].load] = x;
    solution.col(static_cast<Eigen::Index>(c)) = x;
  }
  return solution;
}

std::vector<int> AlgebraicSolver::iterations() const { return parts_->iterations; }

}  // namespace cleft
