#include "encoder/series_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <optional>

#include "base/error.h"
#include "encoder/parallel.h"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));  // absent in other BLAS libraries

namespace cleft {

namespace {

// Of the regularisation: what is tried, from the strongest to the weakest, beginning with the usual one; what
// costs the data nothing; and what knots are compared with.
constexpr double strengths[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
constexpr int usual = 1;
constexpr double hardly_any = 1e-10, of_search = 1e-6;
constexpr double regularisation_cost = 1.05;  // of the data's error, at most
constexpr double of_first = 0.02;             // and of the first frame, of which one column tells little
constexpr double time_roughness = 1e-9;       // holds what few frames leave open
constexpr double residual_bound = 1e-5;       // of the right-hand side, where iterations stop
constexpr int most_iterations = 60;

std::array<BSplineBasis, 3> in_space(const std::array<BSplineBasis, 4>& bases) {
  return {bases[0], bases[1], bases[2]};
}

/// Frames run in parallel: the BLAS library need not.
void one_thread_a_product() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

Misfit misfit_of(const Eigen::MatrixX3d& errors, double limit) {
  const Eigen::VectorXd distances = errors.rowwise().norm();
  return {distances.maxCoeff(), (distances.array() > limit).cast<double>().mean()};
}

}  // namespace

double space_misfit(const Series& series, const Parametrization& parametrization,
                    const std::array<BSplineBasis, 3>& bases, const std::vector<std::size_t>& frames,
                    double limit, double most) {
  one_thread_a_product();
  const FrameFit fit(series, parametrization, bases);
  std::atomic<double> sum = 0;
  parallel_for(static_cast<int>(frames.size()), [&](int i) {
    if (sum > most) return;
    const std::size_t frame = frames[static_cast<std::size_t>(i)];
    const auto factor = fit.space().factorize(fit.normal(frame, of_search));
    sum += misfit_of(fit.misfit(factor.solve(fit.project(frame)), frame), limit).beyond;
  });
  return sum;
}

SeriesFit::SeriesFit(const Series& series, std::shared_ptr<const Parametrization> parametrization,
                     const std::array<BSplineBasis, 4>& bases, Start start)
    : series_(series),
      parametrization_(std::move(parametrization)),
      bases_(bases),
      fit_(series, *parametrization_, in_space(bases)),
      first_(start == Start::zero ? 1 : 0) {
  one_thread_a_product();
  const auto frames = static_cast<Eigen::Index>(series.times.size());
  const BSplineBasis& time = bases_[3];
  in_time_ = Eigen::MatrixXd::Zero(frames - first_, time.size() - first_);
  for (Eigen::Index j = first_; j < frames; ++j) {
    const auto b = time.evaluate(parametrization_->time(series.times[j]).value);
    for (int l = 0; l <= time.degree(); ++l)
      if (b.first + l >= first_) in_time_(j - first_, b.first + l - first_) = b.value[l];
  }
  choose_strength();
  solve();
}

/// The strongest regularisation that costs the first, an early and the last frame next to nothing.
void SeriesFit::choose_strength() {
  const std::size_t frames = series_.times.size(), some[] = {1, 1 + frames / 8, frames - 1};
  int chosen[3];
  parallel_for(3, [&](int i) {
    const std::size_t j = some[i];
    const Eigen::MatrixX3d right = fit_.project(j);
    const auto cost = [&](double of) {
      return fit_.misfit(fit_.space().factorize(fit_.normal(j, of)).solve(right), j).norm();
    };
    const double most =
        regularisation_cost * cost(hardly_any) + (j == 1 ? of_first : 1e-9) * series_.frames[j].norm();
    int strength = usual;
    if (cost(strengths[strength]) <= most)
      while (strength > 0 && cost(strengths[strength - 1]) <= most) --strength;
    else
      do ++strength;
      while (strength + 1 < static_cast<int>(std::size(strengths)) && cost(strengths[strength]) > most);
    chosen[i] = strength;
  });
  strength_ = strengths[*std::max_element(chosen, chosen + 3)];
}

void SeriesFit::solve() {
  const int frames = static_cast<int>(in_time_.rows()), T = static_cast<int>(in_time_.cols()),
            n = ties().size();
  const TipPath& tip = parametrization_->geometry().tip;
  const bool same = !parametrization_->moves() || tip.positions.front() == tip.positions.back();

  // In t: values^T values, with what holds control points that few frames see; its Cholesky factor.
  Eigen::MatrixXd in_t = in_time_.transpose() * in_time_;
  const double hold = time_roughness * in_t.diagonal().mean();
  Eigen::MatrixXd roughness = Eigen::MatrixXd::Zero(T, T);
  for (int i = 1 - first_; i + 1 < T; ++i) {  // second differences; a first control point of 0 is one of them
    Eigen::VectorXd d = Eigen::VectorXd::Zero(T);
    if (i > 0) d(i - 1) = 1;
    d(i) = -2, d(i + 1) = 1;
    roughness += d * d.transpose();
  }
  in_t += hold * (roughness + Eigen::MatrixXd::Identity(T, T));
  const Eigen::LLT<Eigen::MatrixXd> time_factor(in_t);

  // Right-hand side, T blocks of n x 3, and the frames' normal matrices.
  using Blocks = std::vector<Eigen::MatrixXd>;
  Blocks projected(frames);
  std::vector<SpaceFit::Normal> normals(same ? 1 : frames);
  parallel_for(frames, [&](int j) {
    const auto frame = static_cast<std::size_t>(j + first_);
    projected[j] = fit_.project(frame);
    if (!same || j == 0) normals[j] = fit_.normal(frame, strength_);
  });
  const auto over_frames = [&](const Blocks& of_frames) {
    Blocks sums(T);
    parallel_for(T, [&](int l) {
      sums[l] = Eigen::MatrixXd::Zero(n, 3);
      for (int j = 0; j < frames; ++j)
        if (in_time_(j, l) != 0) sums[l] += in_time_(j, l) * of_frames[j];
    });
    return sums;
  };
  const auto mixed = [&](const Eigen::MatrixXd& factors, const Blocks& x) {
    Blocks y(T);
    parallel_for(T, [&](int l) {
      y[l] = Eigen::MatrixXd::Zero(n, 3);
      for (int k = 0; k < T; ++k)
        if (factors(l, k) != 0) y[l] += factors(l, k) * x[k];
    });
    return y;
  };
  const Blocks right = over_frames(projected);

  // The preconditioner: L^-T blockdiag(N_l)^-1 L^-1 with N_l the mean of the normal matrices that l sees.
  std::vector<std::optional<SpaceFit::Factor>> factors(same ? 1 : T);
  parallel_for(static_cast<int>(factors.size()), [&](int l) {
    SpaceFit::Normal sum;
    if (same) {
      sum = normals[0];
    } else {
      double all = 0;
      for (int j = 0; j < frames; ++j) all += in_time_(j, l) * in_time_(j, l);
      for (int j = 0; j < frames; ++j)
        if (const double part = in_time_(j, l) * in_time_(j, l); part > 0)
          sum.add(part / all, normals[j]);
        else if (all == 0 && j == std::min(l, frames - 1))
          sum.add(1, normals[j]);
    }
    factors[l].emplace(fit_.space().factorize(sum));
  });
  for (const auto& factor : factors) condition_ = std::max(condition_, factor->condition());
  const Eigen::MatrixXd inverse = time_factor.matrixL().solve(Eigen::MatrixXd::Identity(T, T));  // L^-1
  const auto precondition = [&](const Blocks& x) {
    Blocks y = mixed(inverse, x);
    parallel_for(T, [&](int l) { y[l] = factors[same ? 0 : l]->solve(std::move(y[l])); });
    return mixed(inverse.transpose(), y);
  };
  const auto multiply = [&](const Blocks& x) {
    Blocks of_frames(frames);
    parallel_for(frames, [&](int j) {
      Eigen::MatrixX3d at = Eigen::MatrixX3d::Zero(n, 3);
      for (int l = 0; l < T; ++l)
        if (in_time_(j, l) != 0) at += in_time_(j, l) * x[l];
      of_frames[j] = fit_.space().multiply(normals[j], at);
    });
    return over_frames(of_frames);
  };
  const auto products = [&](const Blocks& a, const Blocks& b) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int l = 0; l < T; ++l) sum += a[l].cwiseProduct(b[l]).colwise().sum();
    return sum;
  };

  // Conjugate gradients, three right-hand sides side by side; exact at once where the matrix is the product.
  Blocks x = precondition(right);
  if (!same) {
    Blocks residual = right;
    {
      const Blocks applied = multiply(x);
      for (int l = 0; l < T; ++l) residual[l] -= applied[l];
    }
    const Eigen::RowVector3d all = products(right, right).cwiseMax(1e-300);
    Blocks z = precondition(residual), direction = z;
    Eigen::RowVector3d rz = products(residual, z);
    while (iterations_ < most_iterations && (products(residual, residual).array() / all.array()).maxCoeff() >
                                                residual_bound * residual_bound) {
      const Blocks applied = multiply(direction);
      const Eigen::RowVector3d curvature = products(direction, applied);
      Eigen::RowVector3d step = Eigen::RowVector3d::Zero();
      for (int a = 0; a < 3; ++a) step(a) = curvature(a) > 0 ? rz(a) / curvature(a) : 0;
      for (int l = 0; l < T; ++l) {
        x[l] += direction[l] * step.asDiagonal();
        residual[l] -= applied[l] * step.asDiagonal();
      }
      z = precondition(residual);
      const Eigen::RowVector3d next = products(residual, z);
      for (int l = 0; l < T; ++l) {
        Eigen::RowVector3d keep = Eigen::RowVector3d::Zero();
        for (int a = 0; a < 3; ++a) keep(a) = rz(a) > 0 ? next(a) / rz(a) : 0;
        direction[l] = z[l] + direction[l] * keep.asDiagonal();
      }
      rz = next;
      ++iterations_;
    }
  }
  control_points_.resize(T, 3 * n);
  for (int l = 0; l < T; ++l) control_points_.row(l) = x[l].reshaped().transpose();
}

Misfit SeriesFit::misfit(double limit) const {
  const int frames = static_cast<int>(in_time_.rows());
  std::vector<Misfit> misfits(static_cast<std::size_t>(frames));
  parallel_for(frames, [&](int j) {
    const Eigen::RowVectorXd x = in_time_.row(j) * control_points_;
    const auto frame = static_cast<std::size_t>(j + first_);
    misfits[static_cast<std::size_t>(j)] = misfit_of(fit_.misfit(x.reshaped(ties().size(), 3), frame), limit);
  });
  Misfit all;
  for (const Misfit& one : misfits) {
    all.largest = std::max(all.largest, one.largest);
    all.beyond += one.beyond / static_cast<double>(frames);
  }
  return all;
}

std::vector<Vec3> SeriesFit::coefficients(const Eigen::MatrixXd& control_points) const {
  const int n = ties().size();
  std::vector<Vec3> coefficients;
  for (int i = 0; i < ties().rows(); ++i)
    for (const ControlTies::Control& control : ties().row(i)) {
      if (first_ > 0) coefficients.emplace_back();
      for (Eigen::Index l = 0; l < control_points.rows(); ++l) {
        Vec3& c = coefficients.emplace_back();
        for (int axis = 0; axis < 3; ++axis)
          for (int k = 0; k < control.terms; ++k)
            c[axis] += control.term[k].weight *
                       control_points(l, axis * n + ties().first(i) + control.term[k].unknown);
      }
    }
  return coefficients;
}

}  // namespace cleft
