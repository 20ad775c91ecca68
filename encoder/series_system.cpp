#include "encoder/series_system.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "base/parallel.h"
#include "encoder/space_factor.h"

namespace cleft {

namespace {

constexpr int most_iterations = 500;
constexpr double least_hold = 1e-9;  // of all in t, where frames are fewer than control points
constexpr double negligible = 1e-3;  // of a frame in a block, over the frame that counts most there

/// D^T D of second differences; a first control point that is 0 is one of them.
Eigen::MatrixXd roughness_in_time(int size, bool from_zero) {
  Eigen::MatrixXd roughness = Eigen::MatrixXd::Zero(size, size);
  for (int i = from_zero ? 0 : 1; i + 1 < size; ++i) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(size);
    if (i > 0) d(i - 1) = 1;
    d(i) = -2, d(i + 1) = 1;
    roughness += d * d.transpose();
  }
  return roughness;
}

/// R with R^T (B^T B + hold) R = 1, such that each transformed control point depends as far as possible on
/// one frame only: rows of (B, H) R, hold = H^T H, as many as there are control points and as independent as
/// can be, come near to the identity.
Eigen::MatrixXd one_frame_each(const Eigen::MatrixXd& in_time, const Eigen::MatrixXd& hold) {
  const auto frames = in_time.rows(), T = in_time.cols();
  const Eigen::MatrixXd root =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(in_time.transpose() * in_time + hold)
          .operatorInverseSqrt();
  Eigen::MatrixXd rows(frames + T, T);
  rows << in_time, upper_cholesky_factor(hold);
  rows *= root;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> independent(rows.transpose());
  const Eigen::MatrixXd chosen = (independent.colsPermutation().transpose() * rows).topRows(T);
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> polar(  // of a square matrix
      chosen, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return root * polar.matrixV() * polar.matrixU().transpose();
}

Eigen::RowVector3d products(const SeriesSystem::Blocks& a, const SeriesSystem::Blocks& b) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (std::size_t l = 0; l < a.size(); ++l) sum += a[l].cwiseProduct(b[l]).colwise().sum();
  return sum;
}

/// a / b, of components that are not there 0.
Eigen::RowVector3d ratio(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
  Eigen::RowVector3d result = Eigen::RowVector3d::Zero();
  for (int c = 0; c < 3; ++c)
    if (b(c) > 0) result(c) = a(c) / b(c);
  return result;
}

}  // namespace

SeriesSystem::SeriesSystem(const SpaceFit& space, const Eigen::MatrixXd& in_time, bool from_zero,
                           std::vector<SpaceFit::Normal> normals)
    : space_(space), in_time_(in_time), normals_(std::move(normals)) {
  const auto frames = in_time.rows(), T = in_time.cols();
  hold_ = (in_time.squaredNorm() / static_cast<double>(T)) *
          (time_roughness * roughness_in_time(static_cast<int>(T), from_zero) +
           least_hold * Eigen::MatrixXd::Identity(T, T));
  inverse_root_ = one_frame_each(in_time, hold_);
  if (!same())
    for (const SpaceFit::Normal& normal : normals_) mean_.add(1 / static_cast<double>(frames), normal);

  const Eigen::MatrixXd parts = (in_time * inverse_root_).cwiseAbs2(),
                        held = inverse_root_.transpose() * hold_ * inverse_root_;
  factors_.resize(same() ? 1 : static_cast<std::size_t>(T));
  parallel_for(static_cast<int>(factors_.size()), [&](int l) {
    if (same()) return void(factors_[0].emplace(space_.factorize(normals_[0])));
    SpaceFit::Normal sum;
    for (Eigen::Index j = 0; j < frames; ++j)
      if (parts(j, l) > negligible * parts.col(l).maxCoeff()) sum.add(parts(j, l), normals_[j]);
    sum.add(held(l, l), mean_);
    factors_[l].emplace(space_.factorize(sum));
  });
}

double SeriesSystem::condition() const {
  double condition = 1;
  for (const auto& factor : factors_) condition = std::max(condition, factor->condition());
  return condition;
}

double SeriesSystem::bytes() const {
  double sum = mean_.bytes();
  for (const SpaceFit::Normal& normal : normals_) sum += normal.bytes();
  for (const auto& factor : factors_) sum += factor->bytes();
  return sum;
}

SeriesSystem::Blocks SeriesSystem::over_frames(const Blocks& of_frames) const {
  Blocks sums(static_cast<std::size_t>(in_time_.cols()));
  parallel_for(static_cast<int>(sums.size()), [&](int l) {
    Eigen::MatrixXd& sum = sums[l];
    sum = Eigen::MatrixXd::Zero(space_.ties().size(), 3);
    for (Eigen::Index j = 0; j < in_time_.rows(); ++j)
      if (in_time_(j, l) != 0) sum += in_time_(j, l) * of_frames[j];
  });
  return sums;
}

SeriesSystem::Blocks SeriesSystem::mixed(const Eigen::MatrixXd& factors, const Blocks& x) const {
  Blocks y(x.size());
  parallel_for(static_cast<int>(x.size()), [&](int l) {
    Eigen::MatrixXd& sum = y[l];
    sum = Eigen::MatrixXd::Zero(space_.ties().size(), 3);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (const double factor = factors(l, static_cast<Eigen::Index>(k)); factor != 0) sum += factor * x[k];
  });
  return y;
}

SeriesSystem::Blocks SeriesSystem::multiply(const Blocks& x) const {
  const int frames = static_cast<int>(in_time_.rows()), T = static_cast<int>(in_time_.cols());
  const Blocks held = mixed(hold_, x);
  Blocks of_frames(static_cast<std::size_t>(frames)), of_hold(x.size());
  parallel_for(frames + T, [&](int task) {
    if (task >= frames) {
      const std::size_t l = task - frames;
      of_hold[l] = space_.multiply(mean_, held[l]);
      return;
    }
    const std::size_t j = task;
    Eigen::MatrixXd at = Eigen::MatrixXd::Zero(space_.ties().size(), 3);
    for (int l = 0; l < T; ++l)
      if (in_time_(task, l) != 0) at += in_time_(task, l) * x[l];
    of_frames[j] = space_.multiply(normals_[j], at);
  });
  Blocks sums = over_frames(of_frames);
  for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += of_hold[l];
  return sums;
}

/// R blockdiag(N)^-1 R^T.
SeriesSystem::Blocks SeriesSystem::precondition(const Blocks& x) const {
  Blocks y = mixed(inverse_root_.transpose(), x);
  parallel_for(static_cast<int>(y.size()), [&](int i) {
    const std::size_t l = i;
    y[l] = factors_[same() ? 0 : l]->solve(std::move(y[l]));
  });
  return mixed(inverse_root_, y);
}

SeriesSystem::Blocks SeriesSystem::solve(const Blocks& right, double bound, int& iterations) const {
  Blocks x = precondition(right);
  iterations = 0;
  if (same()) return x;  // the matrix is the product
  const auto add = [](Blocks& to, const Blocks& block, const Eigen::RowVector3d& factors) {
    for (std::size_t l = 0; l < to.size(); ++l) to[l] += block[l] * factors.asDiagonal();
  };
  const Eigen::RowVector3d one = Eigen::RowVector3d::Ones(), all = products(right, right).cwiseMax(1e-300);
  Blocks residual = right;
  add(residual, multiply(x), -one);
  // Three right-hand sides side by side.
  Blocks z = precondition(residual), direction = z;
  Eigen::RowVector3d rz = products(residual, z);
  while (iterations < most_iterations &&
         (products(residual, residual).array() / all.array()).maxCoeff() > bound * bound) {
    const Blocks applied = multiply(direction);
    const Eigen::RowVector3d step = ratio(rz, products(direction, applied));
    add(x, direction, step);
    add(residual, applied, -step);
    z = precondition(residual);
    const Eigen::RowVector3d next = products(residual, z);
    Blocks turned = z;
    add(turned, direction, ratio(next, rz));
    direction = std::move(turned);
    rz = next;
    ++iterations;
  }
  return x;
}

}  // namespace cleft
