#include "solver/direct_solver.h"

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <map>

#include "solver/elimination_order.h"

namespace cleft {

namespace {

using Triplet = Eigen::Triplet<double, int>;

/// The triplets of all ranks, on rank 0.
std::vector<Triplet> gather(const PatchSystem& system, const std::vector<Triplet>& local) {
  const bool root = system.rank() == 0;
  const int ranks = static_cast<int>(system.offsets().size()) - 1;
  int bytes = static_cast<int>(local.size() * sizeof(Triplet));
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, system.communicator());
  for (int r = 1; r < ranks; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<Triplet> all(root ? (starts.back() + counts.back()) / sizeof(Triplet) : 0);
  MPI_Gatherv(local.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0,
              system.communicator());
  return all;
}

}  // namespace

DirectSolver::DirectSolver(const PatchMesh& mesh, const PatchSystem& system)
    : system_(system),
      cut_(mesh, system),
      factor_(system, cut_.unknowns,
              system.rank() == 0 ? elimination_order(mesh, system, cut_.unknowns) : std::vector<int>()) {
  for (const NodePair& pair : mesh.pairs) normals_.push_back(pair.normal);
}

double DirectSolver::bytes_needed() const {
  const double cut = static_cast<double>(cut_.unknowns.size());
  const double dense = system_.rank() == 0 ? 6 * cut * cut : 0;
  constexpr double blocks = 4 * 64;  // of frames: displacements, residuals and what they are made of
  return factor_.bytes_needed() + 8 * (dense + blocks * system_.owned());
}

void DirectSolver::factorize() {
  factor_.factorize();
  std::map<int, int> cut_place;
  for (std::size_t i = 0; i < cut_.unknowns.size(); ++i) cut_place[cut_.unknowns[i]] = static_cast<int>(i);
  std::vector<Triplet> entries;
  const Epetra_CrsMatrix& matrix = system_.stiffness();
  for (int row = 0; row < matrix.NumMyRows(); ++row) {
    if (cut_place.count(matrix.GRID(row))) continue;
    int count = 0, *columns = nullptr;
    double* values = nullptr;
    matrix.ExtractMyRowView(row, count, values, columns);
    for (int i = 0; i < count; ++i)
      if (const auto found = cut_place.find(matrix.GCID(columns[i])); found != cut_place.end())
        entries.emplace_back(matrix.GRID(row), found->second, values[i]);
  }
  entries = gather(system_, entries);
  on_root(system_, [&] {
    keep_coupling(std::move(entries));
    condensation_.emplace(factor_.schur(), cut_.pairs);
  });
}

void DirectSolver::keep_coupling(std::vector<Eigen::Triplet<double>> entries) {
  for (const Triplet& entry : entries) neighbors_.push_back(entry.row());
  std::sort(neighbors_.begin(), neighbors_.end());
  neighbors_.erase(std::unique(neighbors_.begin(), neighbors_.end()), neighbors_.end());
  for (Triplet& entry : entries)
    entry = {static_cast<int>(std::lower_bound(neighbors_.begin(), neighbors_.end(), entry.row()) -
                              neighbors_.begin()),
             entry.col(), entry.value()};
  coupling_.resize(static_cast<Eigen::Index>(neighbors_.size()),
                   static_cast<Eigen::Index>(cut_.unknowns.size()));
  coupling_.setFromTriplets(entries.begin(), entries.end());
}

void DirectSolver::set_release(const Release& release) {
  loads_.clear();
  on_root(system_, [&] {
    opening_.emplace(*condensation_,
                     std::vector<int>(release.order.begin(), release.order.begin() + release.released.back()),
                     normals_);
  });
}

void DirectSolver::set_loads(Block loads) {
  const Eigen::MatrixXd at_cut = gather_rows(system_, loads, cut_.unknowns);
  for (const int unknown : cut_.unknowns) {
    const int local = unknown - system_.first();
    if (local >= 0 && local < system_.owned()) loads.row(local).setZero();
  }
  std::vector<Triplet> entries;
  for (Eigen::Index c = 0; c < loads.cols(); ++c)
    for (Eigen::Index i = 0; i < loads.rows(); ++i)
      if (loads(i, c) != 0)
        entries.emplace_back(system_.first() + static_cast<int>(i), static_cast<int>(c), loads(i, c));
  entries = gather(system_, entries);
  Eigen::SparseMatrix<double> right(system_.size(), loads.cols());
  right.setFromTriplets(entries.begin(), entries.end());
  interior_ = factor_.solve(right);
  const Eigen::MatrixXd carried = gather_rows(system_, system_.multiply(interior_), cut_.unknowns);
  loads_.clear();
  if (system_.rank() == 0)
    for (Eigen::Index c = 0; c < loads.cols(); ++c)
      loads_.push_back(opening_->prepare(at_cut.col(c) - carried.col(c)));
}

Block DirectSolver::solve(const std::vector<Column>& columns) {
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd at_cut(static_cast<Eigen::Index>(cut_.unknowns.size()), count);
  Eigen::SparseMatrix<double> right(system_.size(), count);
  on_root(system_, [&] {
    for (Eigen::Index c = 0; c < count; ++c) {
      const Column& column = columns[static_cast<std::size_t>(c)];
      at_cut.col(c) = opening_->displacement(loads_[column.load], column.open, column.contact);
    }
    const Eigen::MatrixXd pull = coupling_ * at_cut;  // K_ii u_i = f_i - K_ic u_c
    right.reserve(Eigen::VectorXi::Constant(count, static_cast<int>(neighbors_.size())));
    for (Eigen::Index c = 0; c < count; ++c)
      for (std::size_t i = 0; i < neighbors_.size(); ++i)
        right.insert(neighbors_[i], c) = -pull(static_cast<Eigen::Index>(i), c);
  });
  MPI_Bcast(at_cut.data(), static_cast<int>(at_cut.size()), MPI_DOUBLE, 0, system_.communicator());
  Block solution = factor_.solve(right);
  for (Eigen::Index c = 0; c < count; ++c)
    solution.col(c) += interior_.col(columns[static_cast<std::size_t>(c)].load);
  for (std::size_t i = 0; i < cut_.unknowns.size(); ++i) {
    const int local = cut_.unknowns[i] - system_.first();
    if (local >= 0 && local < system_.owned()) solution.row(local) = at_cut.row(static_cast<Eigen::Index>(i));
  }
  return solution;
}

}  // namespace cleft
