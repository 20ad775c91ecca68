#include "explorer/analysis/interactions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <openturns/GaussLegendre.hxx>

namespace cleft {

namespace {

constexpr int along_each = 6;                         // nodes of the quadrature, along each parameter
constexpr int draw_groups = 4, draws_in_a_group = 8;  // draws of the other parameters
constexpr std::size_t most_parameters = 6;            // whose pairs are looked at

struct Quadrature {
  std::vector<double> parts;  // 0 to 1, increasing
  Eigen::VectorXd weights;    // of sum 1
};

Quadrature quadrature() {
  const OT::GaussLegendre rule(OT::Indices(1, along_each));
  const OT::Sample places = rule.getNodes();
  const OT::Point weights = rule.getWeights();
  std::vector<std::pair<double, double>> pairs;
  for (OT::UnsignedInteger k = 0; k < along_each; ++k) pairs.emplace_back(places(k, 0), weights[k]);
  std::sort(pairs.begin(), pairs.end());
  Quadrature q{{}, Eigen::VectorXd(along_each)};
  for (Eigen::Index k = 0; k < along_each; ++k)
    q.parts.push_back(pairs[static_cast<std::size_t>(k)].first),
        q.weights[k] = pairs[static_cast<std::size_t>(k)].second;
  q.weights /= q.weights.sum();
  return q;
}

/// The parameters of the pairs, in their order.
std::vector<std::size_t> most_together(const Sensitivities& found) {
  std::vector<std::size_t> list(found.parameters.size());
  std::iota(list.begin(), list.end(), std::size_t{0});
  const auto together = [&](std::size_t k) {
    return found.parameters[k].total.value - found.parameters[k].first.value;
  };
  std::stable_sort(list.begin(), list.end(),
                   [&](std::size_t a, std::size_t b) { return together(a) > together(b); });
  list.resize(std::min(list.size(), most_parameters));
  std::sort(list.begin(), list.end());
  return list;
}

/// A figure at all nodes of a pair (rows: of the one; columns: of the other), averaged over each group of
/// draws.
using GroupMeans = std::vector<Eigen::MatrixXd>;

/// values: of the draws one after another, for each node of the one, for each of the other.
GroupMeans means_of(const Eigen::VectorXd& values) {
  GroupMeans means(draw_groups, Eigen::MatrixXd::Zero(along_each, along_each));
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const Eigen::Index place = j / (draw_groups * draws_in_a_group);
    means[static_cast<std::size_t>(j % draw_groups)](place % along_each, place / along_each) +=
        values[j] / draws_in_a_group;
  }
  return means;
}

/// What remains of means at nodes without the mean effects of each parameter.
Eigen::MatrixXd beyond_alone(Eigen::MatrixXd means, const Eigen::VectorXd& weights) {
  means.colwise() -= Eigen::VectorXd(means * weights);
  means.rowwise() -= Eigen::RowVectorXd(weights.transpose() * means);
  return means;
}

/// The variance that a pair makes together, by products of different draw_groups, whose draws are different
/// ones: what averages of few draws are off by does not add to it. A group that is left out: -1 for none.
double variance_together(const GroupMeans& rests, const Eigen::VectorXd& weights, int left_out = -1) {
  double sum = 0;
  int products = 0;
  for (int a = 0; a < draw_groups; ++a)
    for (int b = 0; b < a; ++b) {
      if (a == left_out || b == left_out) continue;
      const Eigen::MatrixXd product =
          rests[static_cast<std::size_t>(a)].cwiseProduct(rests[static_cast<std::size_t>(b)]);
      sum += weights.dot(product * weights);
      ++products;
    }
  return sum / products;
}

}  // namespace

std::vector<Interaction> interactions_of(const std::vector<InputDistribution>& distributions,
                                         const FigureFunction& figure, const AlternativeFigures& alternatives,
                                         const Sensitivities& found) {
  const Quadrature q = quadrature();
  const Eigen::Index draws = draw_groups * draws_in_a_group;
  const double variance = found.deviation * found.deviation;
  const auto rests_of = [&](GroupMeans means) {
    for (Eigen::MatrixXd& one : means) one = beyond_alone(std::move(one), q.weights);
    return means;
  };
  std::vector<Interaction> list;
  const std::vector<std::size_t> parameters = most_together(found);
  for (std::size_t a = 0; a < parameters.size(); ++a)
    for (std::size_t b = a + 1; b < parameters.size(); ++b) {
      Interaction& pair = list.emplace_back(Interaction{parameters[a], parameters[b], {}, {}, {}, {}});
      for (const double part : q.parts)
        pair.at.push_back(distributions[pair.one].quantile(part)),
            pair.other_at.push_back(distributions[pair.other].quantile(part));
      Eigen::MatrixXd points(found.points.rows(), draws * along_each * along_each);
      for (Eigen::Index place = 0; place < along_each * along_each; ++place) {
        auto some = points.middleCols(place * draws, draws);
        for (Eigen::Index s = 0; s < draws; ++s) some.col(s) = found.points.col(s % found.points.cols());
        some.row(static_cast<Eigen::Index>(pair.one))
            .setConstant(pair.at[static_cast<std::size_t>(place % along_each)]);
        some.row(static_cast<Eigen::Index>(pair.other))
            .setConstant(pair.other_at[static_cast<std::size_t>(place / along_each)]);
      }
      const GroupMeans means = means_of(figure(points));
      pair.mean = Eigen::MatrixXd::Zero(along_each, along_each);
      for (const Eigen::MatrixXd& one : means) pair.mean += one / draw_groups;
      // Few draws of the others shift all places alike: the mean of all is known better.
      pair.mean.array() += found.mean - q.weights.dot(pair.mean * q.weights);
      const GroupMeans rests = rests_of(means);
      Eigen::VectorXd of_draws(draw_groups);
      for (int g = 0; g < draw_groups; ++g) of_draws[g] = variance_together(rests, q.weights, g) / variance;
      const Eigen::MatrixXd others = alternatives ? alternatives(points) : Eigen::MatrixXd(0, points.cols());
      Eigen::VectorXd of_data(others.rows());
      for (Eigen::Index k = 0; k < others.rows(); ++k)
        of_data[k] = variance_together(rests_of(means_of(others.row(k).transpose())), q.weights) / variance;
      pair.share = {std::clamp(variance_together(rests, q.weights) / variance, 0., 1.),
                    std::hypot(jackknife_error(of_draws), jackknife_error(of_data))};
    }
  std::stable_sort(list.begin(), list.end(),
                   [](const Interaction& x, const Interaction& y) { return x.share.value > y.share.value; });
  return list;
}

}  // namespace cleft
