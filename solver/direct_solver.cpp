#include "solver/direct_solver.h"

#include <algorithm>
#include <unordered_map>

#include "solver/block_rows.h"
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

/// Sums triplets of the same place, in their order.
std::vector<Triplet> summed(std::vector<Triplet> all) {
  std::stable_sort(all.begin(), all.end(), [](const Triplet& a, const Triplet& b) {
    return std::pair(a.row(), a.col()) < std::pair(b.row(), b.col());
  });
  std::size_t count = 0;
  for (const Triplet& one : all)
    if (count > 0 && all[count - 1].row() == one.row() && all[count - 1].col() == one.col())
      all[count - 1] = {one.row(), one.col(), all[count - 1].value() + one.value()};
    else
      all[count++] = one;
  all.resize(count);
  return all;
}

std::vector<int> right_unknowns(const PatchMesh& mesh, const PatchSystem& system) {
  std::vector<int> unknowns;
  for (const NodePair& pair : mesh.pairs)
    for (int axis = 0; axis < 3; ++axis) unknowns.push_back(system.unknown(pair.right, axis));
  return unknowns;
}

}  // namespace

DirectSolver::DirectSolver(const PatchMesh& mesh, const PatchSystem& system, PatchSystem::Entries entries)
    : system_(system),
      cut_(mesh, system),
      jump_unknowns_(right_unknowns(mesh, system)),
      factor_(system, stiffness_with_jumps(std::move(entries)), jump_unknowns_,
              system.rank() == 0 ? elimination_order(mesh, system, jump_unknowns_) : std::vector<int>()) {
  for (const NodePair& pair : mesh.pairs) normals_.push_back(pair.normal);
}

void DirectSolver::replace(PatchSystem::Entries entries) {
  opening_.reset(), neighbors_.clear(), coupling_entries_.clear();
  factor_.replace(stiffness_with_jumps(std::move(entries)));
}

PatchSystem::Entries DirectSolver::stiffness_with_jumps(PatchSystem::Entries entries) {
  std::unordered_map<int, int> left_of,
      number;  // by unknown of a right node: that of the left one, of the jump
  for (const auto& [left, right] : cut_.pairs)
    for (int axis = 0; axis < 3; ++axis)
      left_of[cut_.unknowns[3 * right + axis]] = cut_.unknowns[3 * left + axis];
  for (std::size_t i = 0; i < jump_unknowns_.size(); ++i) number[jump_unknowns_[i]] = static_cast<int>(i);
  std::vector<bool> is_jump(static_cast<std::size_t>(system_.size()), false), at_cut = is_jump;
  for (const int unknown : jump_unknowns_) is_jump[unknown] = true;
  for (const int unknown : cut_.unknowns) at_cut[unknown] = true;
  // A displacement is the sum of these: itself, or its jump, that of its left node, ...
  const auto terms = [&](int unknown) {
    std::vector<int> list = {unknown};
    while (is_jump[list.back()]) list.push_back(left_of.at(list.back()));
    return list;
  };

  std::size_t others = 0;  // that stay
  std::vector<Triplet> at_the_cut;
  for (std::size_t i = 0; i < entries.value.size(); ++i) {
    const int row = entries.row[i], column = entries.column[i];
    const double value = entries.value[i];
    if (!at_cut[row] && !at_cut[column]) {
      entries.row[others] = row, entries.column[others] = column, entries.value[others++] = value;
      continue;
    }
    const bool diagonal = row == column;  // any other entry also represents its mirror image
    for (const int a : terms(row))
      for (const int b : terms(column))
        if (!diagonal || a <= b)
          at_the_cut.emplace_back(std::max(a, b), std::min(a, b), !diagonal && a == b ? 2 * value : value);
  }
  entries.row.resize(others), entries.column.resize(others), entries.value.resize(others);
  // Summed here: MUMPS would add what ranks give of the same entry in the order in which it arrives.
  for (const Triplet& entry : summed(gather(system_, at_the_cut))) {
    const int row = entry.row(), column = entry.col();
    entries.row.push_back(row), entries.column.push_back(column), entries.value.push_back(entry.value());
    if (is_jump[row] != is_jump[column])
      coupling_entries_.emplace_back(is_jump[row] ? column : row, number[is_jump[row] ? row : column],
                                     entry.value());
  }
  return entries;
}

double DirectSolver::bytes_needed() const {
  const double jumps = static_cast<double>(jump_unknowns_.size());
  const double dense = system_.rank() == 0 ? 4 * jumps * jumps : 0;
  constexpr double blocks = 4 * 40;  // of frames: displacements, residuals and what they are made of
  return factor_.bytes_needed() + 8 * (dense + blocks * system_.owned());
}

void DirectSolver::factorize() {
  factor_.factorize();
  std::vector<Triplet> entries = std::move(coupling_entries_);
  for (const Triplet& entry : entries) neighbors_.push_back(entry.row());
  std::sort(neighbors_.begin(), neighbors_.end());
  neighbors_.erase(std::unique(neighbors_.begin(), neighbors_.end()), neighbors_.end());
  if (system_.rank() == 0) {
    for (Triplet& entry : entries)
      entry = {static_cast<int>(std::lower_bound(neighbors_.begin(), neighbors_.end(), entry.row()) -
                                neighbors_.begin()),
               entry.col(), entry.value()};
    coupling_.resize(static_cast<Eigen::Index>(neighbors_.size()),
                     static_cast<Eigen::Index>(jump_unknowns_.size()));
    coupling_.setFromTriplets(entries.begin(), entries.end());
  }
  int count = static_cast<int>(neighbors_.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, system_.communicator());
  neighbors_.resize(count);
  MPI_Bcast(neighbors_.data(), count, MPI_INT, 0, system_.communicator());
}

bool DirectSolver::is_definite(const Release& release, int open, const std::vector<int>& touching) const {
  int definite = 1;
  if (system_.rank() == 0)
    definite = Opening::is_definite(factor_.schur(), {release.order.begin(), release.order.begin() + open},
                                    touching, normals_);
  MPI_Bcast(&definite, 1, MPI_INT, 0, system_.communicator());
  return definite != 0;
}

void DirectSolver::set_release(const Release& release) {
  loads_.clear();
  on_root(system_, [&] {
    opening_.emplace(factor_.schur(),
                     std::vector<int>(release.order.begin(), release.order.begin() + release.released.back()),
                     normals_);
  });
}

Eigen::MatrixXd DirectSolver::to_pulls(Block& loads) const {
  Eigen::MatrixXd pulls = all_gather_rows(system_, loads, cut_.unknowns);
  cut_.to_pulls(pulls);
  set_rows(system_, loads, cut_.unknowns, pulls);
  return pulls;
}

void DirectSolver::to_displacements(Block& solution) const {
  Eigen::MatrixXd at_cut = all_gather_rows(system_, solution, cut_.unknowns);
  cut_.to_displacements(at_cut);
  set_rows(system_, solution, cut_.unknowns, at_cut);
}

void DirectSolver::set_loads(Block loads, Together together) {
  together_ = together;
  const Eigen::Index columns = loads.cols();
  const Eigen::MatrixXd pulls = to_pulls(loads);
  for (const int unknown : jump_unknowns_)
    if (const int row = system_.row(unknown); row >= 0) loads.row(row).setZero();
  std::vector<Triplet> entries;
  for (Eigen::Index c = 0; c < columns; ++c)
    for (Eigen::Index i = 0; i < loads.rows(); ++i)
      if (loads(i, c) != 0)
        entries.emplace_back(system_.first() + static_cast<int>(i), static_cast<int>(c), loads(i, c));
  entries = gather(system_, entries);
  Eigen::SparseMatrix<double> right(system_.size(), columns);
  right.setFromTriplets(entries.begin(), entries.end());
  if (together == Together::all) interior_ = factor_.solve(right);
  if (together == Together::each) interior_.resize(loads.rows(), columns);
  for (Eigen::Index c = 0; c < columns && together == Together::each; ++c)
    interior_.col(c) = factor_.solve(right.col(c));
  const Eigen::MatrixXd near = gather_rows(system_, interior_, neighbors_);
  loads_.clear();
  if (system_.rank() != 0) return;
  for (Eigen::Index c = 0; c < columns; ++c) {
    Eigen::VectorXd pull = -(coupling_.transpose() * near.col(c));
    for (std::size_t p = 0; p < cut_.pairs.size(); ++p)
      pull.segment<3>(3 * p) += pulls.col(c).segment<3>(3 * cut_.pairs[p][1]);
    loads_.push_back(opening_->prepare(pull));
  }
}

Block DirectSolver::solve(const std::vector<Column>& columns) {
  if (together_ == Together::all) return solve_together(columns);
  Block solution(system_.owned(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t first = 0, end = 0; first < columns.size(); first = end) {
    while (end < columns.size() && columns[end].load == columns[first].load) ++end;
    solution.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(end - first)) =
        solve_together({columns.begin() + static_cast<std::ptrdiff_t>(first),
                        columns.begin() + static_cast<std::ptrdiff_t>(end)});
  }
  return solution;
}

Block DirectSolver::solve_together(const std::vector<Column>& columns) {
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd jumps(static_cast<Eigen::Index>(jump_unknowns_.size()), count);
  Eigen::SparseMatrix<double> right(system_.size(), count);
  on_root(system_, [&] {
    for (Eigen::Index c = 0; c < count; ++c) {
      const Column& column = columns[c];
      jumps.col(c) = opening_->jumps(loads_[column.load], column.open, column.contact);
    }
    const Eigen::MatrixXd pull = coupling_ * jumps;  // K_ii x_i = f_i - K_ia a
    right.reserve(Eigen::VectorXi::Constant(count, static_cast<int>(neighbors_.size())));
    for (Eigen::Index c = 0; c < count; ++c)
      for (std::size_t i = 0; i < neighbors_.size(); ++i)
        if (const double p = pull(static_cast<Eigen::Index>(i), c); p != 0)
          right.insert(neighbors_[i], c) = -p;
  });
  MPI_Bcast(jumps.data(), static_cast<int>(jumps.size()), MPI_DOUBLE, 0, system_.communicator());
  Block solution = factor_.solve(right);
  for (Eigen::Index c = 0; c < count; ++c) solution.col(c) += interior_.col(columns[c].load);
  set_rows(system_, solution, jump_unknowns_, jumps);
  to_displacements(solution);
  return solution;
}

Block DirectSolver::solve_each(const Block& loads, const std::vector<Frame>& frames) {
  Block pulls = loads;
  to_pulls(pulls);
  Block solution = factor_.solve(pulls, [&](Eigen::MatrixXd& kept) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto& [open, touching] = frames[i];
      auto own = kept.col(static_cast<Eigen::Index>(i));
      own = opening_->jumps(opening_->prepare(own), open, touching.places, touching.openings);
    }
  });
  to_displacements(solution);
  return solution;
}

}  // namespace cleft
