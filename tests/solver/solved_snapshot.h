// Cases solved to snapshots, and what stands in them.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>

#include "solver/snapshot/snapshot.h"
#include "solver/solve.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

/// An array of the points in all frames, a column each.
inline Eigen::MatrixXd array_of(const std::string& path, const std::string& name) {
  const SnapshotReader reader(path);
  const auto rows = static_cast<Eigen::Index>(reader.snapshot().points.size());
  std::vector<Eigen::VectorXd> frames;
  if (name == "displacement") {
    for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) {
      const std::vector<Vec3> u = reader.displacement(j);
      frames.emplace_back(Eigen::Map<const Eigen::VectorXd>(&u.front().x, 3 * rows));
    }
  } else {
    const std::vector<SnapshotArray> arrays = reader.point_arrays();
    const auto found =
        std::find_if(arrays.begin(), arrays.end(), [&](const SnapshotArray& a) { return a.name == name; });
    if (found == arrays.end()) {
      ADD_FAILURE() << path << " has no array " << name;
      return {};
    }
    for (std::size_t j = 0; j < (found->varies ? reader.snapshot().frames() : 1); ++j) {
      const std::vector<double> values = reader.point_array(*found, j);
      frames.emplace_back(
          Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
    }
  }
  Eigen::MatrixXd all(frames.front().size(), static_cast<Eigen::Index>(frames.size()));
  for (std::size_t j = 0; j < frames.size(); ++j) all.col(static_cast<Eigen::Index>(j)) = frames[j];
  return all;
}

inline Eigen::MatrixXd displacement_of(const std::string& path) { return array_of(path, "displacement"); }

/// Largest difference / largest entry of the second.
inline double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(a.cols(), b.cols());
  if (a.rows() != b.rows() || a.cols() != b.cols() || b.size() == 0) return 1;
  return (a - b).cwiseAbs().maxCoeff() / std::max(1e-300, b.cwiseAbs().maxCoeff());
}

/// Solves cases into a folder as 0.h5, 1.h5, ...
inline std::vector<SolveReport> solve_into(const TemporaryFolder& folder,
                                           const std::vector<Parameters>& cases,
                                           const SolveOptions& options = {}) {
  std::vector<CaseToSolve> to_solve;
  for (std::size_t c = 0; c < cases.size(); ++c)
    to_solve.push_back({cases[c], folder / std::to_string(c) + ".h5"});
  return solve_cases(to_solve, options, MPI_COMM_WORLD, [](const std::string&) {});
}

/// The series of one case solved by itself.
inline Eigen::MatrixXd solved_alone(const Parameters& p, const SolveOptions& options = {}) {
  const TemporaryFolder folder;
  const SolveReport report = solve_into(folder, {p}, options)[0];
  EXPECT_EQ(report.failure, "");
  return report.failure.empty() ? displacement_of(report.out) : Eigen::MatrixXd();
}

}  // namespace cleft
