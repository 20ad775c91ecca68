#include "encoder/field/coefficient_state.h"

#include <algorithm>

namespace cleft::code {

namespace {

constexpr std::int64_t unknown_error = 77;  // 0.3, where nothing is known

}  // namespace

CoefficientState::Channel::Channel(const CoefficientGrid& grid, int width)
    : innovation(grid.along, width, grid.height, 0),
      error(grid.along, width, grid.height, unknown_error),
      earlier(grid.along, width, grid.height, unknown_error),
      residual(grid.along, width, grid.height, 2) {}

CoefficientState::CoefficientState(const CoefficientGrid& grid, int slices)
    : values(static_cast<std::size_t>(components) * slices * grid.unknowns),
      grid_(grid),
      slices_(slices),
      width_{grid.across / 2, grid.across - grid.across / 2},
      closed_(static_cast<std::size_t>(grid.unknowns)) {
  for (int half = 0; half < 2; ++half) {
    for (int c = 0; c < components; ++c) channels_[half].emplace_back(grid, width_[1]);
    places_[half] = places_of(half);
  }
  past_.resize(std::max(places_[0].size(), places_[1].size()));
  nothing_.assign(channels_[0][0].innovation.size(), 0);
}

std::vector<CoefficientState::Place> CoefficientState::places_of(int half) const {
  std::vector<Place> places;
  for (int i = 0; i < grid_.along; ++i)
    for (int j = 0; j < width_[half]; ++j)
      for (int k = 0; k < grid_.height; ++k) {
        const auto unknown_at = [&](int column) {
          return grid_.unknown[(static_cast<std::size_t>(i) * grid_.across + column) * grid_.height + k];
        };
        const int column = half == 0 ? j : grid_.across - 1 - j, unknown = unknown_at(column);
        const bool paired = half == 0 || j < width_[0];
        if (unknown >= 0)
          places.push_back({channels_[half][0].innovation.index(i, j, k), unknown, j,
                            paired ? unknown_at(grid_.across - 1 - column) : -1});
      }
  return places;
}

/// The closed state before the first slice is 0 everywhere; so may be what there is none of.
const std::int64_t* CoefficientState::slice_values(int c, int slice) const {
  return slice < 0 ? closed_.data() : &values[first(c, slice)];
}

const std::vector<CoefficientState::Past>& CoefficientState::past(const SliceStep& step, int c, int half) {
  const bool between = step.after >= 0;
  const std::int64_t toward_after =
      between ? ((2 * 65536LL * (step.slice - step.before)) / (step.after - step.before) + 1) / 2 : 0;
  const std::int64_t per_step = between ? 65536 / (step.after - step.before) : 0,
                     per_step_before = step.before_that != -2 ? 65536 / (step.before - step.before_that) : 0,
                     per_step_after = step.after_that != -2 ? 65536 / (step.after_that - step.after) : 0;
  const std::int64_t *const before = slice_values(c, step.before), *const after = slice_values(c, step.after),
                            *const before_that = slice_values(c, step.before_that),
                            *const after_that = slice_values(c, step.after_that);
  // The components coded before this one in this slice, the later first; and the other half's.
  Channel& own = channels_[half][c];
  Channel& last = channels_[half][component_order[2]];
  const int rank = c == 1 ? 0 : c == 2 ? 1 : 2;
  Channel* const near = rank > 0 ? &channels_[half][component_order[rank - 1]] : nullptr;
  Channel* const far = rank > 1 ? &channels_[half][component_order[0]] : nullptr;
  const std::int32_t* const near_innovation = near ? near->innovation.data() : nothing_.data();
  const std::int32_t* const far_innovation = far ? far->innovation.data() : nothing_.data();
  const std::int64_t* const near_error = near ? near->error.data() : last.earlier.data();
  const std::int64_t* const far_error = far ? far->error.data() : last.earlier.data();
  const std::int32_t* const twin = half == 1 ? channels_[0][c].innovation.data() : nothing_.data();
  const std::int32_t twin_sign = c == 1 ? -1 : 1;
  const std::ptrdiff_t A = own.innovation.step_along(), B = own.innovation.step_across();
  Past* known = past_.data();
  for (const Place& place : places_[half]) {
    const std::int64_t from = before[place.unknown], to = after[place.unknown];
    known->base = (from * (65536 - toward_after) + to * toward_after) >> 8;
    known->inputs = FourInputs{0, 0, 0, place.across < width_[0] ? twin_sign * twin[place.at] : 0};
    if (between) {
      const std::int64_t slope = (to - from) * per_step;
      known->inputs[0] = limited((to - from) * 64);
      if (step.before_that != -2)
        known->inputs[1] = limited(((from - before_that[place.unknown]) * per_step_before - slope) >> 8);
      if (step.after_that != -2)
        known->inputs[2] = limited(((after_that[place.unknown] - to) * per_step_after - slope) >> 8);
    } else
      known->base = 0;
    const std::int64_t* const p = own.earlier.data() + place.at;
    known->ahead = p[A] + p[B] + p[1];
    known->here = p[0];
    known->spread = known->ahead + 3 * (p[0] + near_error[place.at]) + 2 * far_error[place.at];
    known->near_innovation = near_innovation[place.at];
    known->far_innovation = far_innovation[place.at];
    ++known;
  }
  return past_;
}

}  // namespace cleft::code
