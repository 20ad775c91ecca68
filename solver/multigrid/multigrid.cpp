#include "solver/multigrid/multigrid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"

namespace cleft {

namespace {

constexpr int relaxations = 12;             // before and after the coarser level
constexpr double longest_joined = 2.4;      // element, over the shortest of the finer level
constexpr std::size_t most_coarsest = 250;  // nodes of the coarsest level

}  // namespace

Multigrid::Multigrid(const DoubledGrid& grid, Level finest, MPI_Comm communicator,
                     const std::function<int(int)>& owner)
    : grid_(grid), communicator_(communicator) {
  levels_.push_back(std::move(finest));
  finish_level(levels_.front(), grid, communicator, owner);
  for (;;) {
    Level& last = levels_.back();
    const std::size_t nodes = grid.count(last.lines);
    if (nodes <= most_coarsest) break;
    GridLines lines = last.lines;
    double shortest = grid.shortest(lines);
    do {
      lines = grid.coarser(last.lines, longest_joined * shortest);
      shortest *= 1.3;
    } while (grid.count(lines) > nodes * 3 / 5 && shortest < 1e3 * grid.shortest(last.lines));
    if (grid.count(lines) > nodes * 4 / 5) break;
    levels_.push_back(coarser_level(last, grid, std::move(lines), communicator, owner));
  }

  // The coarsest matrix, on every rank.
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  const Level& coarsest = levels_.back();
  coarse_counts_.resize(ranks), coarse_offsets_.assign(ranks, 0);
  MPI_Allgather(&coarsest.owned, 1, MPI_INT, coarse_counts_.data(), 1, MPI_INT, communicator);
  std::partial_sum(coarse_counts_.begin(), coarse_counts_.end() - 1, coarse_offsets_.begin() + 1);
  coarse_numbers_.resize(static_cast<std::size_t>(coarse_offsets_.back()) + coarse_counts_.back());
  MPI_Allgatherv(coarsest.numbers.data(), coarsest.owned, MPI_INT, coarse_numbers_.data(),
                 coarse_counts_.data(), coarse_offsets_.data(), MPI_INT, communicator);
  std::map<int, int> local;
  for (std::size_t n = 0; n < coarse_numbers_.size(); ++n) local[coarse_numbers_[n]] = static_cast<int>(n);
  std::vector<Eigen::Triplet<double, int>> own;
  for (int n = 0; n < coarsest.owned; ++n)
    for (std::int64_t k = coarsest.matrix.start[n]; k < coarsest.matrix.start[n + 1]; ++k)
      for (int e = 0; e < 9; ++e)
        own.emplace_back(3 * local[coarsest.numbers[n]] + e / 3,
                         3 * local[coarsest.numbers[coarsest.matrix.column[k]]] + e % 3,
                         coarsest.matrix.value[9 * k + e]);
  const int bytes = static_cast<int>(own.size() * sizeof(own[0]));
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  coarse_matrix_.resize((static_cast<std::size_t>(starts.back()) + counts.back()) / sizeof(own[0]));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, coarse_matrix_.data(), counts.data(), starts.data(), MPI_BYTE,
                 communicator);
}

void Multigrid::set_release(std::vector<int> opens_after) {
  opens_after_ = {std::move(opens_after)};
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l)
    opens_after_.push_back(grid_.opens_after(opens_after_[l], levels_[l].lines, levels_[l + 1].lines));
  factors_.clear();
  estimate_eigenvalues();
}

void Multigrid::set_lanes(std::vector<int> open) {
  open_ = std::move(open);
  lanes_ = &lane_table(static_cast<int>(open_.size()));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].resize(lanes_->lanes);
    levels_[l].ties.set(opens_after_[l], open_.data(), lanes_->lanes);
  }
  lane_factors_.clear();
  for (const int pairs : open_) lane_factors_.push_back(&tied_factor(pairs));
}

/// The largest eigenvalue of the tridiagonal matrix of steps of conjugate gradients (Lanczos), with all pairs
/// closed and with all open.
void Multigrid::estimate_eigenvalues() {
  for (Level& level : levels_) level.largest = 0;
  for (const int open : {0, std::numeric_limits<int>::max()}) {
    set_lanes({open});
    for (Level& level : levels_) level.largest = std::max(level.largest, 1.1F * largest_eigenvalue(level));
  }
}

float Multigrid::largest_eigenvalue(Level& level) {
  constexpr int steps = 16;
  const std::size_t own = std::size_t{3} * level.owned;
  const auto dot = [&](const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t u = 0; u < own; ++u) sum += static_cast<double>(a[u]) * b[u];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator_);
    return sum;
  };
  std::vector<float> rest(level.b.size(), 0), step(level.b.size(), 0);
  for (int n = 0; n < level.owned; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const unsigned seed = 2654435761U * static_cast<unsigned>(level.numbers[n]) + 40503U * axis;
      rest[std::size_t{3} * n + axis] = static_cast<float>(seed >> 8 & 1023) / 1024.F - 0.5F;
    }
  std::fill(level.b.begin(), level.b.end(), 0.F);
  Eigen::MatrixXd tridiagonal = Eigen::MatrixXd::Zero(steps, steps);
  double first = 0, before = 0, length = 0, turn = 0;
  for (int i = 0; i < steps; ++i) {
    level.r = rest;
    level.tie(level.r, 1);
    lanes_->relax(level.owned, level.inverse.data(), 0, 1, level.r.data(), level.d.data(), level.x.data());
    const double now = dot(rest, level.d);
    if (i == 0) first = now;
    if (i > 0 && std::abs(now) < 1e-10 * first) {  // all of a small level's eigenvalues are found
      tridiagonal.conservativeResize(i, i);
      break;
    }
    if (!(now > 0)) throw IndefiniteLevel("by the diagonal of a level of the multigrid");
    turn = i == 0 ? 0 : now / before;
    for (std::size_t u = 0; u < own; ++u) step[u] = level.d[u] + static_cast<float>(turn) * step[u];
    level.x = step;
    residual(level);  // - A x
    const double energy = -dot(step, level.r);
    if (!(energy > 0)) throw IndefiniteLevel("by a level of the multigrid");
    if (i > 0) {
      tridiagonal(i, i) = turn / length;
      tridiagonal(i, i - 1) = tridiagonal(i - 1, i) = std::sqrt(turn) / length;
    }
    length = now / energy, before = now;
    tridiagonal(i, i) += 1 / length;
    for (std::size_t u = 0; u < own; ++u) rest[u] += static_cast<float>(length) * level.r[u];
  }
  return static_cast<float>(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tridiagonal, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff());
}

void Multigrid::residual(Level& level) {
  level.halo.update(level.x.data(), 3 * lanes_->lanes);
  lanes_->residual(level.matrix.rows(), level.b.data(), level.x.data(), level.r.data());
}

void Multigrid::smooth(Level& level, bool from_zero) {
  float keep = 0;
  for (int k = 1; k <= relaxations; ++k) {
    if (k == 1 && from_zero)
      std::copy(level.b.begin(), level.b.end(), level.r.begin());
    else
      residual(level);
    level.tie(level.r, lanes_->lanes);
    const float step = static_cast<float>(8 * k - 4) / static_cast<float>(2 * k + 1) / level.largest;
    keep = static_cast<float>(2 * k - 3) / static_cast<float>(2 * k + 1);
    if (k == 1 && !from_zero) std::fill(level.d.begin(), level.d.end(), 0.F);
    lanes_->relax(level.owned, level.inverse.data(), k == 1 && from_zero ? 0 : keep, step, level.r.data(),
                  level.d.data(), level.x.data());
  }
}

void Multigrid::apply() { cycle(0); }

void Multigrid::cycle(std::size_t number) {
  if (number + 1 == levels_.size()) return solve_coarsest();
  Level& level = levels_[number];
  Level& coarse = levels_[number + 1];
  const int width = 3 * lanes_->lanes;
  smooth(level, true);
  residual(level);
  std::fill(coarse.b.begin(), coarse.b.end(), 0.F);
  lanes_->restrict_to(level.up.rows(), level.r.data(), coarse.b.data());
  coarse.halo.add_to_owners(coarse.b.data(), width);
  cycle(number + 1);
  coarse.halo.update(coarse.x.data(), width);
  lanes_->prolong(level.up.rows(), coarse.x.data(), level.x.data());
  smooth(level, false);
}

const Multigrid::TiedFactor& Multigrid::tied_factor(int open) {
  const std::vector<int>& after = opens_after_.back();
  std::map<int, int> local;
  for (std::size_t n = 0; n < coarse_numbers_.size(); ++n) local[coarse_numbers_[n]] = static_cast<int>(n);
  std::vector<int> group;
  for (const int number : coarse_numbers_) {
    int first = number;
    for (int pair = grid_.pair_of(first); pair >= 0 && open <= after[pair]; pair = grid_.pair_of(first))
      first = grid_.pairs()[pair].left;
    group.push_back(local.at(first));
  }
  std::unique_ptr<TiedFactor>& found = factors_[group];
  if (found) return *found;
  found = std::make_unique<TiedFactor>();
  found->unknown_of.assign(group.size(), -1);
  for (std::size_t n = 0; n < group.size(); ++n)
    if (group[n] == static_cast<int>(n)) found->unknown_of[n] = found->groups++;
  for (std::size_t n = 0; n < group.size(); ++n) found->unknown_of[n] = found->unknown_of[group[n]];
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const auto& entry : coarse_matrix_)
    entries.emplace_back(3 * found->unknown_of[entry.row() / 3] + entry.row() % 3,
                         3 * found->unknown_of[entry.col() / 3] + entry.col() % 3, entry.value());
  Eigen::SparseMatrix<double> matrix(3 * found->groups, 3 * found->groups);
  matrix.setFromTriplets(entries.begin(), entries.end());
  found->factor.compute(matrix);
  if (found->factor.info() != Eigen::Success) throw IndefiniteLevel("by the coarsest level of the multigrid");
  return *found;
}

void Multigrid::solve_coarsest() {
  Level& level = levels_.back();
  const int lanes = lanes_->lanes, width = 3 * lanes;
  std::vector<float> whole(coarse_numbers_.size() * width);
  std::vector<int> counts(coarse_counts_), offsets(coarse_offsets_);
  for (int& count : counts) count *= width;
  for (int& offset : offsets) offset *= width;
  MPI_Allgatherv(level.b.data(), level.owned * width, MPI_FLOAT, whole.data(), counts.data(), offsets.data(),
                 MPI_FLOAT, communicator_);
  int rank = 0;
  MPI_Comm_rank(communicator_, &rank);
  for (int lane = 0; lane < lanes; ++lane) {
    const TiedFactor& tied = *lane_factors_[lane];
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(3 * tied.groups);
    for (std::size_t n = 0; n < coarse_numbers_.size(); ++n)
      for (int axis = 0; axis < 3; ++axis)
        sum(3 * tied.unknown_of[n] + axis) += whole[(3 * n + axis) * lanes + lane];
    const Eigen::VectorXd solution = tied.factor.solve(sum);
    for (int n = 0; n < level.owned; ++n)
      for (int axis = 0; axis < 3; ++axis)
        level.x[(std::size_t{3} * n + axis) * lanes + lane] =
            static_cast<float>(solution(3 * tied.unknown_of[coarse_offsets_[rank] + n] + axis));
  }
}

}  // namespace cleft
