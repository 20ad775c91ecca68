#include "encoder/field/field.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

Field::Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
             CanonicalCut cut)
    : bases_{std::move(u), std::move(v), std::move(w), std::move(t)},
      coefficients_(std::move(coefficients)),
      cut_(cut) {
  std::size_t count = 1;
  for (const BSplineBasis& b : bases_) count *= b.size();
  CLEFT_CHECK(coefficients_.size(), ==, count);
}

std::vector<Vec3> Field::contract(const Vec3& uvw, Side side) const {
  if (uvw.y == 0 && side == Side::both) {
    std::vector<Vec3> mean = contract(uvw, Side::left);
    const std::vector<Vec3> right = contract(uvw, Side::right);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = lerp(mean[i], right[i], 0.5);
    return mean;
  }
  const auto bu = bases_[0].evaluate(uvw.x), bw = bases_[2].evaluate(uvw.z);
  const auto bv = bases_[1].evaluate(uvw.y, side == Side::left ? Limit::from_left : Limit::from_right);
  const auto size = [this](int axis) { return bases_[axis].size(); };
  std::vector<Vec3> history(size(3));
  for (int i = 0; i <= bases_[0].degree(); ++i)
    for (int j = 0; j <= bases_[1].degree(); ++j)
      for (int k = 0; k <= bases_[2].degree(); ++k) {
        const double weight = bu.value[i] * bv.value[j] * bw.value[k];
        const std::size_t row = ((bu.first + i) * size(1) + (bv.first + j)) * size(2) + (bw.first + k);
        for (std::size_t l = 0; l < history.size(); ++l)
          history[l] += weight * coefficients_[row * history.size() + l];
      }
  return history;
}

Vec3 Field::displacement(const Vec3& uvw, Side side, double t) const {
  if (uvw.y == 0 && side == Side::both)
    return lerp(displacement(uvw, Side::left, t), displacement(uvw, Side::right, t), 0.5);
  const auto bu = bases_[0].evaluate(uvw.x), bw = bases_[2].evaluate(uvw.z), bt = bases_[3].evaluate(t);
  const auto bv = bases_[1].evaluate(uvw.y, side == Side::left ? Limit::from_left : Limit::from_right);
  const std::size_t V = bases_[1].size(), W = bases_[2].size(), T = bases_[3].size();
  Vec3 sum;
  for (int i = 0; i <= bases_[0].degree(); ++i)
    for (int j = 0; j <= bases_[1].degree(); ++j) {
      const double row_weight = bu.value[i] * bv.value[j];
      Vec3 row_sum;
      for (int k = 0; k <= bases_[2].degree(); ++k) {
        const Vec3* c =
            &coefficients_[(((bu.first + i) * V + (bv.first + j)) * W + (bw.first + k)) * T + bt.first];
        Vec3 along_t;
        for (int l = 0; l <= bases_[3].degree(); ++l) along_t += bt.value[l] * c[l];
        row_sum += bw.value[k] * along_t;
      }
      sum += row_weight * row_sum;
    }
  return sum;
}

Vec3 evaluate(const BSplineBasis& t_basis, std::span<const Vec3> history, double t) {
  const auto b = t_basis.evaluate(t);
  Vec3 sum;
  for (int l = 0; l <= t_basis.degree(); ++l) sum += b.value[l] * history[b.first + l];
  return sum;
}

}  // namespace cleft
