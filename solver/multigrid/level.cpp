#include "solver/multigrid/level.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "base/error.h"

namespace cleft {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Matrix3f = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;

/// Local numbers of nodes, to which others are added as they are met.
class Numbering {
 public:
  explicit Numbering(std::vector<int>& numbers) : numbers_(numbers) {
    for (std::size_t n = 0; n < numbers.size(); ++n) local_[numbers[n]] = static_cast<int>(n);
  }
  int operator()(int number) {
    const auto [found, is_new] = local_.try_emplace(number, static_cast<int>(numbers_.size()));
    if (is_new) numbers_.push_back(number);
    return found->second;
  }

 private:
  std::vector<int>& numbers_;
  std::unordered_map<int, int> local_;
};

/// Rows of blocks that grow.
class GrowingRows {
 public:
  Matrix3& at(int row, int column) {
    if (row >= static_cast<int>(rows_.size())) rows_.resize(row + 1);
    Row& r = rows_[row];
    const auto found = std::find(r.columns.begin(), r.columns.end(), column);
    if (found != r.columns.end()) return r.blocks[found - r.columns.begin()];
    r.columns.push_back(column);
    return r.blocks.emplace_back(Matrix3::Zero());
  }
  std::size_t size() const { return rows_.size(); }
  struct Row {
    std::vector<int> columns;
    std::vector<Matrix3> blocks;
  };
  Row& row(int number) { return rows_[number]; }

 private:
  std::vector<Row> rows_;
};

/// Sends the rows of other ranks' nodes to them, and adds what others send.
void hand_over(GrowingRows& sum, std::vector<int>& numbers, int owned, Numbering& numbering,
               MPI_Comm communicator, const std::function<int(int)>& owner) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  if (ranks == 1) return;
  std::vector<std::vector<int>> places(ranks);  // row, column in the mesh
  std::vector<std::vector<double>> values(ranks);
  for (int row = owned; row < static_cast<int>(sum.size()); ++row) {
    GrowingRows::Row& r = sum.row(row);
    const int to = owner(numbers[row]);
    for (std::size_t k = 0; k < r.columns.size(); ++k) {
      places[to].insert(places[to].end(), {numbers[row], numbers[r.columns[k]]});
      values[to].insert(values[to].end(), r.blocks[k].data(), r.blocks[k].data() + 9);
    }
    r = {};
  }
  const auto all_to_all = [&](auto& send, MPI_Datatype type) {
    using Vector = std::decay_t<decltype(send[0])>;
    Vector out, in;
    std::vector<int> sent(ranks), received(ranks), from(ranks, 0), to(ranks, 0);
    for (int r = 0; r < ranks; ++r) sent[r] = static_cast<int>(send[r].size());
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, communicator);
    for (int r = 1; r < ranks; ++r) from[r] = from[r - 1] + sent[r - 1], to[r] = to[r - 1] + received[r - 1];
    for (const auto& part : send) out.insert(out.end(), part.begin(), part.end());
    in.resize(static_cast<std::size_t>(to.back()) + received.back());
    MPI_Alltoallv(out.data(), sent.data(), from.data(), type, in.data(), received.data(), to.data(), type,
                  communicator);
    return in;
  };
  const std::vector<int> where = all_to_all(places, MPI_INT);
  const std::vector<double> what = all_to_all(values, MPI_DOUBLE);
  for (std::size_t k = 0; 2 * k < where.size(); ++k) {
    const int row = numbering(where[2 * k]), column = numbering(where[2 * k + 1]);
    CLEFT_CHECK(row, <, owned);
    sum.at(row, column) += Eigen::Map<const Matrix3>(what.data() + 9 * k);
  }
}

/// The own rows, each in the order of its columns.
NodeMatrix compressed(GrowingRows& sum, int owned) {
  NodeMatrix matrix;
  std::vector<int> order;
  for (int row = 0; row < owned; ++row) {
    GrowingRows::Row& r = sum.row(row);
    order.resize(r.columns.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return r.columns[a] < r.columns[b]; });
    for (const int k : order) {
      matrix.column.push_back(r.columns[k]);
      for (int e = 0; e < 9; ++e) matrix.value.push_back(static_cast<float>(r.blocks[k].data()[e]));
    }
    matrix.start.push_back(static_cast<std::int64_t>(matrix.column.size()));
    r = {};
  }
  return matrix;
}

/// The sum of the diagonals of a group of copies.
Matrix3f summed_diagonal(const Level& level, const Ties::Place& place, const std::vector<int>& first,
                         int group) {
  Matrix3f sum = Matrix3f::Zero();
  for (std::size_t c = 0; c < place.nodes.size(); ++c)
    if (first[c] == group) sum += Eigen::Map<const Matrix3f>(level.diagonal.data() + 9 * place.nodes[c]);
  return sum;
}

}  // namespace

void Ties::set(const std::vector<int>& opens_after, const int* open, int lanes) {
  for (Place& place : places)
    for (int lane = 0; lane < lanes; ++lane) {
      std::vector<int>& first = place.first[lane];
      first.resize(place.nodes.size());
      for (std::size_t c = 0; c < first.size(); ++c) {  // a right node is the left one of later pairs only
        const bool closed = place.pairs[c] >= 0 && open[lane] <= opens_after[place.pairs[c]];
        first[c] = closed ? first[place.left[c]] : static_cast<int>(c);
      }
    }
}

void Level::resize(int lanes) {
  const std::size_t size = std::size_t{3} * local() * lanes;
  for (auto* vector : {&x, &b, &r, &d}) vector->resize(size);
}

void Level::tie(std::vector<float>& residual, int lanes) const {
  cut_halo.update(residual.data(), 3 * lanes);
  for (const Ties::Place& place : ties.places)
    for (int lane = 0; lane < lanes; ++lane) {
      const std::vector<int>& first = place.first[lane];
      for (std::size_t group = 0; group < first.size(); ++group) {
        if (std::count(first.begin(), first.end(), static_cast<int>(group)) < 2) continue;
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        const auto entry = [&](std::size_t c, int axis) -> float& {
          return residual[(std::size_t{3} * place.nodes[c] + axis) * lanes + lane];
        };
        for (std::size_t c = 0; c < first.size(); ++c)
          if (first[c] == static_cast<int>(group))
            for (int axis = 0; axis < 3; ++axis) sum(axis) += entry(c, axis);
        const Eigen::Vector3f moved =
            summed_diagonal(*this, place, first, static_cast<int>(group)).inverse() * sum;
        for (std::size_t c = 0; c < first.size(); ++c) {
          if (first[c] != static_cast<int>(group)) continue;
          const Eigen::Vector3f own =
              Eigen::Map<const Matrix3f>(diagonal.data() + 9 * place.nodes[c]) * moved;
          for (int axis = 0; axis < 3; ++axis) entry(c, axis) = own(axis);
        }
      }
    }
}

void finish_level(Level& level, const DoubledGrid& grid, MPI_Comm communicator,
                  const std::function<int(int)>& owner) {
  Numbering numbering(level.numbers);
  for (int n = 0; n < level.owned; ++n) {
    const std::vector<int> copies = grid.copies(level.numbers[n]);
    if (copies.size() == 1) continue;
    std::vector<int> local;
    local.reserve(copies.size());
    for (const int copy : copies) local.push_back(numbering(copy));
    // Once for each place: where its first copy of this rank is met.
    if (*std::min_element(local.begin(), local.end()) != n) continue;
    Ties::Place& place = level.ties.places.emplace_back();
    place.nodes = local;
    for (const int copy : copies) {
      const int pair = grid.pair_of(copy);
      place.pairs.push_back(pair);
      const auto left =
          pair < 0 ? copies.end() : std::find(copies.begin(), copies.end(), grid.pairs()[pair].left);
      CLEFT_CHECK(pair < 0 || left != copies.end(), ==, true);
      place.left.push_back(pair < 0 ? -1 : static_cast<int>(left - copies.begin()));
    }
  }
  std::vector<int> copies(static_cast<std::size_t>(level.local() - level.owned)), of_cut;
  std::iota(copies.begin(), copies.end(), level.owned);
  for (const Ties::Place& place : level.ties.places)
    for (const int node : place.nodes)
      if (node >= level.owned) of_cut.push_back(node);
  level.halo = Halo(communicator, level.numbers, level.owned, copies, owner);
  level.cut_halo = Halo(communicator, level.numbers, level.owned, of_cut, owner);

  level.diagonal.assign(std::size_t{9} * level.local(), 0);
  level.inverse.assign(std::size_t{9} * level.owned, 0);
  for (int n = 0; n < level.owned; ++n)
    for (std::int64_t k = level.matrix.start[n]; k < level.matrix.start[n + 1]; ++k)
      if (level.matrix.column[k] == n) {
        std::copy_n(level.matrix.value.data() + 9 * k, 9, level.diagonal.data() + std::size_t{9} * n);
        Eigen::Map<Matrix3f>(level.inverse.data() + std::size_t{9} * n) =
            Eigen::Map<const Matrix3f>(level.matrix.value.data() + 9 * k)
                .cast<double>()
                .inverse()
                .cast<float>();
      }
  level.halo.update(level.diagonal.data(), 9);
}

Level coarser_level(Level& fine, const DoubledGrid& grid, GridLines lines, MPI_Comm communicator,
                    const std::function<int(int)>& owner) {
  Level coarse;
  coarse.lines = std::move(lines);
  for (int n = 0; n < fine.owned; ++n)
    if (grid.has(coarse.lines, fine.numbers[n])) coarse.numbers.push_back(fine.numbers[n]);
  coarse.owned = static_cast<int>(coarse.numbers.size());
  Numbering numbering(coarse.numbers);

  Prolongation all;  // of copies too
  const DoubledGrid::Interpolation interpolation(grid, coarse.lines);
  std::vector<DoubledGrid::Share> shares;
  for (int n = 0; n < fine.local(); ++n) {
    interpolation.shares(fine.numbers[n], shares);
    for (const auto& [node, share] : shares) {
      all.column.push_back(numbering(node));
      all.weight.push_back(static_cast<float>(share));
    }
    all.start.push_back(static_cast<std::int64_t>(all.column.size()));
  }

  GrowingRows sum;
  if (coarse.local() > 0) sum.at(coarse.local() - 1, coarse.local() - 1);
  std::vector<std::pair<int, Matrix3>> row;  // of A P
  std::vector<int> slot(static_cast<std::size_t>(coarse.local()), -1);
  for (int i = 0; i < fine.owned; ++i) {
    row.clear();
    for (std::int64_t k = fine.matrix.start[i]; k < fine.matrix.start[i + 1]; ++k) {
      const Matrix3 block = Eigen::Map<const Matrix3f>(fine.matrix.value.data() + 9 * k).cast<double>();
      const int j = fine.matrix.column[k];
      for (std::int64_t q = all.start[j]; q < all.start[j + 1]; ++q) {
        int& at = slot[all.column[q]];
        if (at < 0) at = static_cast<int>(row.size()), row.emplace_back(all.column[q], Matrix3::Zero());
        row[at].second += static_cast<double>(all.weight[q]) * block;
      }
    }
    for (std::int64_t p = all.start[i]; p < all.start[i + 1]; ++p)
      for (const auto& [column, block] : row)
        sum.at(all.column[p], column) += static_cast<double>(all.weight[p]) * block;
    for (const auto& [column, block] : row) slot[column] = -1;
  }
  hand_over(sum, coarse.numbers, coarse.owned, numbering, communicator, owner);
  coarse.matrix = compressed(sum, coarse.owned);
  fine.up = std::move(all);
  fine.up.start.resize(static_cast<std::size_t>(fine.owned) + 1);
  fine.up.column.resize(fine.up.start.back()), fine.up.weight.resize(fine.up.start.back());
  finish_level(coarse, grid, communicator, owner);
  return coarse;
}

}  // namespace cleft
