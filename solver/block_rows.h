// Rows of distributed blocks by the number of their unknown, and products over all ranks.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/patch_system.h"

namespace cleft {

/// Inner product of two columns over all ranks; equal on each. Collective.
double dot(const PatchSystem& system, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Rows of a distributed block, by number of the unknown: on rank 0, empty elsewhere. Collective.
Eigen::MatrixXd gather_rows(const PatchSystem& system, const Block& block, const std::vector<int>& unknowns);
/// The same on all ranks.
Eigen::MatrixXd all_gather_rows(const PatchSystem& system, const Block& block,
                                const std::vector<int>& unknowns);
/// Sets the rows that this rank owns.
void set_rows(const PatchSystem& system, Block& block, const std::vector<int>& unknowns,
              const Eigen::MatrixXd& rows);

}  // namespace cleft
