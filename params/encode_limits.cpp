#include "params/encode_limits.h"

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr const char* axis_names[] = {"u", "v", "w", "t"};
constexpr std::array<int, 4> least_following_tip = {10, 8, 7, 4}, least_fixed = {4, 8, 4, 4};
constexpr int most_along_axis = 1000;
constexpr double most_control_points = 2e7;  // a file of 240 MB: no summary any more

}  // namespace

void check_regularisation(double strength, const std::string& where) {
  if (!(strength >= least_regularisation && strength <= greatest_regularisation))
    throw InputError(where + " = " + shortest(strength) + ": must be between " +
                     shortest(least_regularisation) + " and " + shortest(greatest_regularisation));
}

void check_control_points(const std::array<int, 4>& counts, const std::string& parametrization,
                          const std::string& where) {
  const auto& least = parametrization == "fixed" ? least_fixed : least_following_tip;
  double product = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (counts[i] < least[i] || counts[i] > most_along_axis)
      throw InputError(where + ": " + std::to_string(counts[i]) + " control points along " + axis_names[i] +
                       ": must be a whole number between " + std::to_string(least[i]) + " and " +
                       std::to_string(most_along_axis) + (i == 1 ? " (both sides of the cut together)" : "") +
                       " where the parametrization is " + parametrization);
    product *= counts[i];
  }
  if (product > most_control_points)
    throw InputError(where + ": " + shortest(product) + " control points in all; at most " +
                     shortest(most_control_points));
}

}  // namespace cleft
