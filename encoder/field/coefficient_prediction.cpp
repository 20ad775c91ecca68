#include "encoder/field/coefficient_prediction.h"

#include <cmath>

namespace cleft::code {

// These functions are here, not in the header: within the coder's one long loop compilers no longer see that
// these are loops over a vector.

std::int64_t Inputs::inverse_size() const {
  auto size = static_cast<std::int32_t>(std::int64_t{10 << 16} >> (2 * shift));
  for (int n = 0; n < inputs; ++n) size += x[n] * x[n];
  // In doubles, several times quicker, and exact: the quotient is off from a whole number by 1 / size or
  // more, if it is none, and size is less than 2^31.
  return static_cast<std::int64_t>(0x1p36 / size);
}

TwoPredictions predict(const Inputs& in, const LinearPredictor& first, const LinearPredictor& second) {
  std::int32_t one = 0, two = 0;
  for (int n = 0; n < inputs; ++n) one += first.weight[n] * in.x[n];
  for (int n = 0; n < inputs; ++n) two += second.weight[n] * in.x[n];
  return {(std::int64_t{one} << in.shift) >> 14, (std::int64_t{two} << in.shift) >> 14};
}

void learn(const Inputs& in, std::int64_t error, int rate, LinearPredictor& predictor) {
  const std::int64_t gain = ((error >> in.shift) * rate * in.inverse) >> 22;
  const auto factor = static_cast<std::int16_t>(std::clamp<std::int64_t>(gain, -511, 511) * 64);
  for (int n = 0; n < inputs; ++n) {
    const auto input = static_cast<std::int16_t>(in.x[n] * 4);
    const auto step = static_cast<std::int16_t>((factor * input) >> 16);
    const auto next = static_cast<std::int16_t>(predictor.weight[n] + step);
    predictor.weight[n] = std::clamp<std::int16_t>(next, -24576, 24576);
  }
}

std::vector<SliceStep> slice_order(int slices) {
  std::vector<SliceStep> order;
  std::vector<bool> known(static_cast<std::size_t>(slices), false);
  const auto add = [&](int slice) {
    SliceStep s{slice, slice - 1, slice + 1, -2, -2};
    while (s.before >= 0 && !known[s.before]) --s.before;
    while (s.after < slices && !known[s.after]) ++s.after;
    if (s.before >= 0)
      for (s.before_that = s.before - 1; s.before_that >= 0 && !known[s.before_that];) --s.before_that;
    if (s.after >= slices)
      s.after = -1;
    else {
      for (s.after_that = s.after + 1; s.after_that < slices && !known[s.after_that];) ++s.after_that;
      if (s.after_that >= slices) s.after_that = -2;
    }
    known[slice] = true;
    order.push_back(s);
  };
  if (slices > 0) add(slices - 1);
  std::vector<std::array<int, 2>> spans{{-1, slices - 1}};
  for (std::size_t n = 0; n < spans.size(); ++n) {
    const auto [from, to] = spans[n];
    if (to - from < 2) continue;
    const int middle = (from + to + 1) / 2;
    add(middle);
    spans.push_back({from, middle});
    spans.push_back({middle, to});
  }
  return order;
}

LogisticTable::LogisticTable() {
  std::size_t at = 0;
  for (int level = 0; level < levels; ++level) {
    const double scale = 0.7 / 256 * (4 + level % 4 + 0.5) * std::pow(2, level / 4 + 1);
    for (int offset = 0; offset < offsets; ++offset) {
      const double f = offset / 32.;
      const auto below = [&](double x) { return 1 / (1 + std::exp(-x / scale)); };
      // below(x) / below(y) for x < y, also where both underflow
      const auto part = [&](double x, double y) {
        return std::exp((x - y) / scale) * (1 + std::exp(y / scale)) / (1 + std::exp(x / scale));
      };
      const double under = -0.5 - f, over = -(0.5 - f);
      std::array<double, decisions> p;
      p[0] = below(under) + below(over);
      p[1] = 1 / (1 + part(over, under));
      for (int tail = 0; tail < 3; ++tail) {
        p[2 + tail] = part(over - tail - 1, over - tail);
        p[5 + tail] = part(under - tail - 1, under - tail);
      }
      for (const double x : p)
        opinion[at++] =
            static_cast<std::int16_t>(std::lround(256 * std::clamp(std::log(x / (1 - x)), -9., 9.)));
    }
  }
}

const LogisticTable logistic;

}  // namespace cleft::code
