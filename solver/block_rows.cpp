#include "solver/block_rows.h"

#include <mpi.h>

namespace cleft {

namespace {

/// The rows that this rank owns, 0 for the others.
Eigen::MatrixXd own_rows(const PatchSystem& system, const Block& block, const std::vector<int>& unknowns) {
  int columns = static_cast<int>(block.cols());
  MPI_Allreduce(MPI_IN_PLACE, &columns, 1, MPI_INT, MPI_MAX, system.communicator());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns.size()), columns);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const int row = system.row(unknowns[i]); row >= 0)
      rows.row(static_cast<Eigen::Index>(i)) = block.row(row);
  }
  return rows;
}

}  // namespace

double dot(const PatchSystem& system, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = a.dot(b);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, system.communicator());
  return sum;
}

Eigen::MatrixXd gather_rows(const PatchSystem& system, const Block& block, const std::vector<int>& unknowns) {
  Eigen::MatrixXd rows = own_rows(system, block, unknowns);
  const bool root = system.rank() == 0;
  MPI_Reduce(root ? MPI_IN_PLACE : rows.data(), rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE,
             MPI_SUM, 0, system.communicator());
  return root ? rows : Eigen::MatrixXd();
}

Eigen::MatrixXd all_gather_rows(const PatchSystem& system, const Block& block,
                                const std::vector<int>& unknowns) {
  Eigen::MatrixXd rows = own_rows(system, block, unknowns);
  MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, MPI_SUM,
                system.communicator());
  return rows;
}

void set_rows(const PatchSystem& system, Block& block, const std::vector<int>& unknowns,
              const Eigen::MatrixXd& rows) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const int row = system.row(unknowns[i]); row >= 0)
      block.row(row) = rows.row(static_cast<Eigen::Index>(i));
  }
}

}  // namespace cleft
