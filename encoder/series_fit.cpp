#include "encoder/series_fit.h"

#include <algorithm>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/parallel.h"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));  // absent in other BLAS libraries

namespace cleft {

namespace {

// Strengths of the regularisation: the candidates, from the strongest to the weakest, and the first one
// tried; one that does not affect the fit; the one for the search of knots; the one for refinement.
constexpr double strengths[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
constexpr int weakest = std::size(strengths) - 1;
constexpr int usual = 1;
constexpr double hardly_any = 1e-10, of_search = 1e-6, weakest_strength = 1e-8;
constexpr double regularisation_cost = 1.05;  // of the data's error, at most
constexpr double of_first = 0.02;  // and of the first frame, which one column of nodes determines poorly
constexpr double residual_bound = 1e-6;  // of the right-hand side, where iterations stop
// Data may be a spline of the space if the relative residual of the fit is at most `nearly`, or that of
// single frames at most `next_to_nothing`. The fit is then refined, and accepted as that spline if its
// residual is at most `found`.
constexpr double nearly = 1e-3, next_to_nothing = 1e-5, found = 1e-11;
constexpr int most_refinements = 40;
// To keep a bound: steps, for which convergence is sure below 2, hardly more than preconditioned; how near is
// near enough; and a step's least gain.
constexpr double keeping_step = 1.9, keeping_residual = 0.1, kept = 1.03, least_gain = 1e-3;
constexpr int most_keeping_steps = 8;

std::array<BSplineBasis, 3> in_space(const std::array<BSplineBasis, 4>& bases) {
  return {bases[0], bases[1], bases[2]};
}

/// Frames run in parallel: the BLAS library need not.
void one_thread_a_product() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

/// At the nodes.
Misfit misfit_of(const Eigen::MatrixX3d& errors, const Series& series, double limit) {
  const Eigen::VectorXd distances = errors.topRows(static_cast<Eigen::Index>(series.nodes)).rowwise().norm();
  return {distances.maxCoeff(), (distances.array() > limit).cast<double>().mean()};
}

}  // namespace

SpaceMisfit space_misfit(const Series& series, FitStore& store, const std::array<BSplineBasis, 3>& bases,
                         std::size_t frame, double limit) {
  one_thread_a_product();
  const auto fit = store.fit(bases);
  const auto factor = store.factor(bases, frame, of_search,
                                   [&] { return fit->space().factorize(fit->normal(frame, of_search)); });
  const Eigen::MatrixX3d x = factor->solve(fit->project(frame, series.frames[frame]));
  Eigen::MatrixX3d left = fit->values(x, frame) - series.frames[frame];
  // Knots would be spent in vain where the coordinates jump, on what a residual holds.
  for (const std::int32_t sample : series.beside_jumps) left.row(sample).setZero();
  SpaceMisfit misfit{misfit_of(left, series, limit)};
  for (const auto& [a, b] : series.pairs)
    misfit.gape = std::max(misfit.gape, (left.row(b) - left.row(a)).norm());
  series.frames.forget(frame);
  return misfit;
}

SeriesFit::SeriesFit(const Series& series, std::shared_ptr<const Parametrization> parametrization,
                     const std::array<BSplineBasis, 4>& bases, Start start, std::optional<double> strength)
    : SeriesFit(series, std::make_shared<FitStore>(series, std::move(parametrization)), bases, start,
                strength) {}

SeriesFit::SeriesFit(const Series& series, std::shared_ptr<FitStore> store,
                     const std::array<BSplineBasis, 4>& bases, Start start, std::optional<double> strength)
    : series_(series),
      store_(std::move(store)),
      parametrization_(store_->parametrization()),
      bases_(bases),
      fit_(store_->fit(in_space(bases))),
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
  if (strength)
    strength_ = *strength, reached_ = 1;
  else
    choose_strength();
  solve();
  if (!strength) refine();
}

/// The strongest regularisation that costs the last, the first and an early frame next to nothing. The last
/// one, whose cut is longest, nearly always decides: of the others it is only asked whether they need a
/// weaker one.
void SeriesFit::choose_strength() {
  const std::size_t last = series_.times.size() - 1, others[] = {1, 1 + (last + 1) / 8};
  Chosen chosen = strength_of(last, usual, Stronger::too), of_other[2];
  parallel_for(2, [&](int i) { of_other[i] = strength_of(others[i], chosen.strength, Stronger::never); });
  for (const Chosen& other : of_other) {
    chosen.strength = std::max(chosen.strength, other.strength);
    chosen.reached = std::max(chosen.reached, other.reached);
  }
  strength_ = strengths[chosen.strength];
  reached_ = chosen.reached;
}

/// Of a frame, from a first strength on.
SeriesFit::Chosen SeriesFit::strength_of(std::size_t frame, int first, Stronger stronger) const {
  const Eigen::MatrixX3d right = fit_->project(frame, series_.frames[frame]);
  std::optional<SpaceFit::Normal> without;
  const auto cost = [&](double strength) {
    const auto factor = store_->factor(in_space(bases_), frame, strength, [&] {
      if (!without) without = fit_->normal(frame, 0);
      SpaceFit::Normal normal = *without;
      fit_->space().roughen(normal, strength);
      return fit_->space().factorize(normal);
    });
    return (fit_->values(factor->solve(right), frame) - series_.frames[frame]).norm();
  };
  const double least = cost(hardly_any), all = series_.frames[frame].norm();
  const double most = regularisation_cost * least + (frame == 1 ? of_first : 1e-9) * all;
  int strength = first;
  while (strength < weakest && cost(strengths[strength]) > most) ++strength;
  if (strength == first && stronger == Stronger::too)
    while (strength > 0 && cost(strengths[strength - 1]) <= most) --strength;
  series_.frames.forget(frame);
  return {strength, least / std::max(all, 1e-300)};
}

void SeriesFit::solve() {
  const int frames = static_cast<int>(in_time_.rows());
  std::vector<Eigen::MatrixXd> projected(static_cast<std::size_t>(frames));
  parallel_for(frames, [&](int j) {
    const std::size_t frame = j + first_;
    projected[j] = fit_->project(frame, series_.frames[frame]);
    series_.frames.forget(frame);
  });
  system_ = system_of(strength_);
  control_points_ = Eigen::MatrixXd::Zero(in_time_.cols(), 3 * ties().size());
  add(system_->solve(system_->over_frames(projected), residual_bound, iterations_));
  condition_ = system_->condition();
}

std::shared_ptr<const SeriesSystem> SeriesFit::system_of(double strength) const {
  return store_->system(bases_, first_, strength, [&] {
    std::vector<SpaceFit::Normal> normals(same_in_all_frames() ? 1
                                                               : static_cast<std::size_t>(in_time_.rows()));
    parallel_for(static_cast<int>(normals.size()),
                 [&](int j) { normals[j] = fit_->normal(frame_of(j), strength); });
    return SeriesSystem(fit_->space(), in_time_, first_ > 0, std::move(normals));
  });
}

Eigen::MatrixXd SeriesFit::control_points_of(const std::vector<Eigen::MatrixX3d>& frames) const {
  std::vector<Eigen::MatrixXd> projected(static_cast<std::size_t>(in_time_.rows()));
  parallel_for(static_cast<int>(projected.size()), [&](int j) {
    const std::size_t frame = j + first_;
    projected[j] = fit_->project(frame, frames[frame]);
  });
  const SeriesSystem::Blocks blocks = system_->solve(system_->over_frames(projected), residual_bound);
  Eigen::MatrixXd points(control_points_.rows(), control_points_.cols());
  for (Eigen::Index l = 0; l < points.rows(); ++l) points.row(l) = blocks[l].reshaped().transpose();
  return points;
}

void SeriesFit::add(const std::vector<Eigen::MatrixXd>& blocks) {
  for (Eigen::Index l = 0; l < control_points_.rows(); ++l)
    control_points_.row(l) += blocks[l].reshaped().transpose();
}

Eigen::MatrixX3d SeriesFit::errors(Eigen::Index j) const {
  const Eigen::RowVectorXd x = in_time_.row(j) * control_points_;
  const std::size_t frame = frame_of(j);
  return fit_->values(x.reshaped(ties().size(), 3), frame) - series_.frames[frame];
}

/// Regularised solutions for what the last one left tend to the one without regularisation that is nearest to
/// the first (the proximal point method). Worth it only where that has no misfit at all.
void SeriesFit::refine() {
  const int frames = static_cast<int>(in_time_.rows());
  const SpaceFit& space = fit_->space();
  std::vector<Eigen::MatrixXd> projected(static_cast<std::size_t>(frames));
  double data = 0;
  for (int j = 0; j < frames; ++j) {
    const std::size_t frame = frame_of(j);
    data += series_.frames[frame].squaredNorm();
    series_.frames.forget(frame);
  }
  const auto project_misfit = [&] {
    Eigen::VectorXd squares(frames);
    parallel_for(frames, [&](int j) {
      const Eigen::MatrixX3d left = errors(j);
      squares(j) = left.squaredNorm();
      projected[j] = space.project(-left, series_.times[j + first_]);
      series_.frames.forget(frame_of(j));
    });
    return std::sqrt(squares.sum() / std::max(data, 1e-300));
  };
  double misfit = project_misfit();
  if ((misfit > nearly && reached_ > next_to_nothing) || data == 0) return;
  std::vector<SpaceFit::Normal> normals(same_in_all_frames() ? 1 : projected.size());
  parallel_for(static_cast<int>(normals.size()),
               [&](int j) { normals[j] = space.normal(series_.times[j + first_], weakest_strength); });
  const SeriesSystem system(space, in_time_, first_ > 0, std::move(normals));
  const Eigen::MatrixXd regularised = control_points_;
  Eigen::MatrixXd best = control_points_;
  for (int refinement = 0; refinement < most_refinements; ++refinement) {
    add(system.solve(system.over_frames(projected), 1e-3));
    const double now = project_misfit();
    if (now < misfit) best = control_points_;
    if (now > 0.5 * misfit) break;
    misfit = now;
  }
  control_points_ = misfit <= found ? best : regularised;
}

/// Uzawa's method: the multiplier of a node is a displacement that is added to its data, and grows by what
/// the node's residual exceeds.
void SeriesFit::keep(double bound) {
  const int frames = static_cast<int>(in_time_.rows());
  const SpaceFit& space = fit_->space();
  const auto nodes = static_cast<Eigen::Index>(series_.nodes);
  std::vector<std::map<Eigen::Index, Eigen::RowVector3d>> multipliers(static_cast<std::size_t>(frames));
  std::vector<Eigen::MatrixXd> changes(static_cast<std::size_t>(frames));
  Eigen::MatrixXd best = control_points_;
  double least = std::numeric_limits<double>::infinity();
  for (int steps = 0;; ++steps) {
    Eigen::VectorXd largest(frames);
    parallel_for(frames, [&](int j) {
      const Eigen::MatrixX3d left = -errors(j);
      series_.frames.forget(frame_of(j));
      largest(j) = left.topRows(nodes).rowwise().norm().maxCoeff();
      Eigen::MatrixX3d change = Eigen::MatrixX3d::Zero(left.rows(), 3);
      auto& of_frame = multipliers[j];
      for (Eigen::Index n = 0; n < nodes; ++n) {
        const auto known = of_frame.find(n);
        if (known == of_frame.end() && left.row(n).squaredNorm() <= bound * bound) continue;
        Eigen::RowVector3d& multiplier = of_frame[n];  // 0 if it is new
        if (known == of_frame.end()) multiplier.setZero();
        const Eigen::RowVector3d moved = multiplier + keeping_step * left.row(n);
        const double length = moved.norm();
        const Eigen::RowVector3d next =
            moved * (std::max(0., length - keeping_step * bound) / std::max(length, 1e-300));
        change.row(n) = next - multiplier;
        multiplier = next;
      }
      changes[j] = space.project(change, series_.times[frame_of(j)]);
    });
    const double before = least;
    if (largest.maxCoeff() < least) least = largest.maxCoeff(), best = control_points_;
    if (least <= kept * bound || least > (1 - least_gain) * before || steps == most_keeping_steps) break;
    add(system_->solve(system_->over_frames(changes), keeping_residual));
  }
  control_points_ = std::move(best);
}

bool SeriesFit::same_in_all_frames() const {
  return !parametrization_->moves() || parametrization_->geometry().tip.still();
}

Misfit SeriesFit::misfit(double limit) const {
  const int frames = static_cast<int>(in_time_.rows());
  std::vector<Misfit> misfits(static_cast<std::size_t>(frames));
  parallel_for(frames, [&](int j) {
    misfits[j] = misfit_of(errors(j), series_, limit);
    series_.frames.forget(frame_of(j));
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
