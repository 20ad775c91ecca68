#include "benchmarks/encoder/pod_rival.h"

#include <Eigen/Dense>

namespace cleft {

Pod::Pod(const NodeData& data) {
  const auto rows = static_cast<Eigen::Index>(3 * data.nodes),
             columns = static_cast<Eigen::Index>(data.frames);
  const Eigen::Map<const Eigen::MatrixXf> snapshots(data.values.data(), rows, columns);
  // Singular vectors over the frames are the eigenvectors of X^T X, which is small.
  const Eigen::MatrixXd x = snapshots.cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(x.transpose() * x);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, columns);
  std::vector<float> approximation(data.values.size());
  for (Eigen::Index k = columns - 1; k >= 0; --k) {
    const Eigen::VectorXd history = gram.eigenvectors().col(k), mode = x * history;
    sum.noalias() += mode * history.transpose();
    Eigen::Map<Eigen::MatrixXf>(approximation.data(), rows, columns) = sum.cast<float>();
    errors_.push_back(errors_of(data, approximation));
  }
  bytes_a_mode_ = 4. * static_cast<double>(rows + columns);
}

Compressed Pod::within(Goal goal, double limit) const {
  std::size_t modes = 1;
  while (modes < errors_.size() && of(errors_[modes - 1], goal) > limit) ++modes;
  return {static_cast<double>(modes) * bytes_a_mode_, errors_[modes - 1], std::to_string(modes) + " modes"};
}

}  // namespace cleft
