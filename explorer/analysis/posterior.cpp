#include "explorer/analysis/posterior.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "base/error.h"

namespace cleft {

namespace {

constexpr int begun_from = 4096;    // points of the cube
constexpr double stretch = 2;       // of a move, at most
constexpr int checked_every = 250;  // steps
constexpr double window = 5;        // autocorrelation times over which correlations are summed (Sokal)

/// Uniform in (0, 1), the same on all platforms.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  int below(int count) { return std::min(count - 1, static_cast<int>((*this)() * count)); }

 private:
  std::mt19937_64 engine_;
};

/// Steps between draws that tell as much as independent ones: of the walkers' mean in the coordinate that is
/// slowest. chain: a matrix dimension x walkers for each step.
double steps_between(const std::vector<Eigen::MatrixXd>& chain) {
  const auto steps = static_cast<Eigen::Index>(chain.size());
  double slowest = 1;
  for (Eigen::Index k = 0; k < chain.front().rows(); ++k) {
    Eigen::MatrixXd walks(chain.front().cols(), steps);
    for (Eigen::Index j = 0; j < steps; ++j)
      walks.col(j) = chain[static_cast<std::size_t>(j)].row(k).transpose();
    walks.array() -= walks.mean();
    const double variance = walks.squaredNorm() / static_cast<double>(walks.size());
    if (!(variance > 0)) continue;
    double time = 1;
    for (Eigen::Index lag = 1; lag < steps / 2 && static_cast<double>(lag) < window * time; ++lag) {
      const double product = walks.leftCols(steps - lag).cwiseProduct(walks.rightCols(steps - lag)).sum();
      time += 2 * product / (static_cast<double>(walks.rows() * (steps - lag)) * variance);
    }
    slowest = std::max(slowest, time);
  }
  return slowest;
}

/// Points of the whole cube, drawn again in proportion to their density, each once if possible.
Eigen::MatrixXd first_walkers(int dimension, int walkers, const LogDensity& density, Random& random) {
  Eigen::MatrixXd points(dimension, begun_from);
  for (double& value : points.reshaped()) value = random();
  const Eigen::VectorXd logarithms = density(points);
  std::vector<std::pair<double, int>> keys;  // the largest are a sample without replacement (Gumbel)
  for (int j = 0; j < begun_from; ++j)
    if (std::isfinite(logarithms[j])) keys.emplace_back(logarithms[j] - std::log(-std::log(random())), j);
  if (std::ssize(keys) < walkers)
    throw InputError(
        "no values of the parameters explain the measurements: their probability is 0 everywhere");
  std::partial_sort(keys.begin(), keys.begin() + walkers, keys.end(), std::greater<>());
  Eigen::MatrixXd chosen(dimension, walkers);
  for (int w = 0; w < walkers; ++w) chosen.col(w) = points.col(keys[static_cast<std::size_t>(w)].second);
  return chosen;
}

}  // namespace

Eigen::VectorXd Posterior::most_likely() const {
  Eigen::Index best = 0;
  logarithms.maxCoeff(&best);
  return points.col(best);
}

Eigen::MatrixXd Posterior::covariance() const {
  const Eigen::MatrixXd centred = points.colwise() - points.rowwise().mean();
  return centred * centred.transpose() / static_cast<double>(points.cols());
}

double Posterior::part_below(double logarithm) const {
  return static_cast<double>((logarithms.array() < logarithm).count()) /
         static_cast<double>(logarithms.size());
}

Posterior draw_posterior(int dimension, const LogDensity& density, const PosteriorSettings& settings) {
  Random random(settings.seed);
  const int half = std::max(settings.walkers, 4 * dimension) / 2;
  Eigen::MatrixXd walkers = first_walkers(dimension, 2 * half, density, random);
  Eigen::VectorXd logarithms = density(walkers);
  Posterior posterior;
  posterior.evaluations = begun_from + 2 * half;
  std::vector<Eigen::MatrixXd> chain;
  std::vector<Eigen::VectorXd> densities;
  for (int step = 1; step <= settings.most_steps; ++step) {
    for (int moving = 0; moving < 2; ++moving) {  // each half by the other
      Eigen::MatrixXd proposed(dimension, half);
      Eigen::VectorXd stretched(half);
      for (int w = 0; w < half; ++w) {
        const double root = 1 / std::sqrt(stretch) + random() * (std::sqrt(stretch) - 1 / std::sqrt(stretch));
        stretched[w] = root * root;
        const auto other = walkers.col((1 - moving) * half + random.below(half));
        proposed.col(w) = other + stretched[w] * (walkers.col(moving * half + w) - other);
      }
      const Eigen::VectorXd found = density(proposed.cwiseMax(0.).cwiseMin(1.));
      posterior.evaluations += half;
      for (int w = 0; w < half; ++w) {
        const int at = moving * half + w;
        const bool inside = proposed.col(w).minCoeff() > 0 && proposed.col(w).maxCoeff() < 1;
        const double accepted = (dimension - 1) * std::log(stretched[w]) + found[w] - logarithms[at];
        if (std::log(random()) < accepted && inside && std::isfinite(found[w]))
          walkers.col(at) = proposed.col(w), logarithms[at] = found[w];
      }
    }
    chain.push_back(walkers), densities.push_back(logarithms);
    if (step % checked_every != 0 && step != settings.most_steps) continue;
    const std::vector<Eigen::MatrixXd> later(chain.begin() + std::ssize(chain) / 2, chain.end());
    posterior.effective = static_cast<double>(later.size()) * 2 * half / steps_between(later);
    if (posterior.effective >= settings.effective) break;
  }
  const std::size_t first = chain.size() / 2, count = chain.size() - first;
  posterior.points.resize(dimension, static_cast<Eigen::Index>(count) * 2 * half);
  posterior.logarithms.resize(posterior.points.cols());
  for (std::size_t j = 0; j < count; ++j) {
    posterior.points.middleCols(static_cast<Eigen::Index>(j) * 2 * half, 2 * half) = chain[first + j];
    posterior.logarithms.segment(static_cast<Eigen::Index>(j) * 2 * half, 2 * half) = densities[first + j];
  }
  return posterior;
}

}  // namespace cleft
