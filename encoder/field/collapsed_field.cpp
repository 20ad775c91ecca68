#include "encoder/field/collapsed_field.h"

#include <algorithm>

#include "base/error.h"
#include "encoder/field/field.h"

namespace cleft {

void Field::collapse(double t, CollapsedField& out) const {
  out.field_ = this;
  out.time_ = parametrization_->inside(t, 3);
  out.stride_[1] = 4 * (*axes_)[2].size();
  out.stride_[0] = out.stride_[1] * (*axes_)[1].size();
  const std::size_t rows = (*axes_)[0].size() * (*axes_)[1].size() * (*axes_)[2].size();
  out.values_.resize(4 * rows);
  double weight[4];
  const int first = (*axes_)[3].evaluate(parametrization_->time(out.time_).value, weight);
  kernels_->collapse(grid_.data() + 4 * first, grid_.stride[2], weight, rows, out.values_.data());
}

Vec3 CollapsedField::displacement(const Vec3& uvw, Side side) const {
  const Place place{uvw, side, time_};
  Vec3 d;
  displacements({&place, 1}, {&d, 1});
  return d;
}

void CollapsedField::displacements(std::span<const Place> places, std::span<Vec3> out) const {
  CLEFT_CHECK(field_, !=, nullptr);
  CLEFT_CHECK(places.size(), ==, out.size());
  constexpr std::size_t at_once = 64;
  Place now[at_once];
  BasisPlace mapped[at_once];
  for (std::size_t begin = 0; begin < places.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, places.size() - begin);
    for (std::size_t i = 0; i < count; ++i) now[i] = {places[begin + i].uvw, places[begin + i].side, time_};
    field_->parametrization_->map({now, count}, mapped);
    field_->kernels_->values_in_space(*field_->axes_, values_.data(), stride_, mapped, count, &out[begin]);
  }
}

}  // namespace cleft
