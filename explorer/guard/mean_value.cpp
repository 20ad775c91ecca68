#include "explorer/guard/mean_value.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleft {

namespace {
/// Radians short of half a turn, at which a place lies on an edge of its ring; and of the ring's size, at
/// which it lies in a corner.
constexpr double on_edge = 1e-9, in_corner = 1e-12;
}  // namespace

std::vector<double> mean_value_weights(const Vec3& place, const std::vector<Vec3>& ring) {
  const std::size_t n = ring.size();
  std::vector<double> angle(n), distance(n), weights(n);
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = ring[i] - place, b = ring[(i + 1) % n] - place;
    distance[i] = norm(a);
    size = std::max(size, distance[i]);
    angle[i] = std::atan2(norm(cross(a, b)), dot(a, b));
    sum += angle[i];
  }
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto half_tangent = [&](std::size_t k) {
      return std::tan(std::min(angle[k] / sum * 2 * std::numbers::pi, std::numbers::pi - on_edge) / 2);
    };
    weights[i] = (half_tangent((i + n - 1) % n) + half_tangent(i)) / std::max(distance[i], in_corner * size);
    total += weights[i];
  }
  for (double& weight : weights) weight /= total;
  return weights;
}

bool eliminate(std::vector<double>& a, std::size_t m, std::size_t columns) {
  for (std::size_t p = 0; p < m; ++p) {
    if (!(a[p * columns + p] > 0)) return false;
    const double inverse = 1 / a[p * columns + p];
    for (std::size_t j = p; j < columns; ++j) a[p * columns + j] *= inverse;
    for (std::size_t i = 0; i < m; ++i) {
      const double factor = a[i * columns + p];
      if (i == p || factor == 0) continue;
      for (std::size_t j = p; j < columns; ++j) a[i * columns + j] -= factor * a[p * columns + j];
    }
  }
  return true;
}

}  // namespace cleft
