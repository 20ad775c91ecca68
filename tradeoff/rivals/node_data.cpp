#include "tradeoff/rivals/node_data.h"

#include <cmath>

namespace cleft {

NodeData::NodeData(const Series& series) : nodes(series.samples.size()), frames(series.times.size() - 1) {
  values.reserve(3 * nodes * frames);
  for (std::size_t j = 1; j <= frames; ++j)
    for (std::size_t n = 0; n < nodes; ++n)
      for (int axis = 0; axis < 3; ++axis)
        values.push_back(static_cast<float>(series.frames[j](static_cast<Eigen::Index>(n), axis)));
  const Errors all = errors_of(*this, std::vector<float>(values.size()));
  largest = all.node_error, squared = all.relative_l2 * all.relative_l2;
}

Errors errors_of(const NodeData& data, const std::vector<float>& approximation) {
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < data.values.size(); i += 3) {
    double square = 0;
    for (std::size_t axis = i; axis < i + 3; ++axis) {
      const double off = static_cast<double>(approximation[axis]) - static_cast<double>(data.values[axis]);
      square += off * off;
    }
    worst = std::max(worst, square), sum += square;
  }
  const bool scaled = data.largest > 0;
  return {std::sqrt(worst) / (scaled ? data.largest : 1), std::sqrt(sum / (scaled ? data.squared : 1))};
}

double of(const Errors& errors, Goal goal) {
  return goal == Goal::node_error ? errors.node_error : errors.relative_l2;
}

Compressed coarsest_within(const std::function<Compressed(double step)>& compress, Goal goal, double limit,
                           double first_step) {
  const auto good = [&](const Compressed& c) { return of(c.errors, goal) <= limit; };
  double low = first_step, high = 2 * first_step;
  Compressed best = compress(low);
  while (!good(best)) high = low, best = compress(low /= 2);
  for (Compressed next = compress(high); good(next); next = compress(high))
    best = next, low = high, high *= 2;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    const Compressed next = compress(middle);
    if (good(next))
      best = next, low = middle;
    else
      high = middle;
  }
  return best;
}

}  // namespace cleft
