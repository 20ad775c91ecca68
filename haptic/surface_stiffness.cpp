#include "haptic/surface_stiffness.h"

#include <numbers>
#include <span>

#include "base/error.h"

namespace cleft {

namespace {
constexpr double radius = stiffness_radius;
}

double stiffness_from_compliance(double compliance) {
  if (!(compliance > 0))
    throw InputError("a compliance of " + std::to_string(compliance) + " mm/MPa is none");
  return std::numbers::pi * radius * radius / compliance;
}

double surface_stiffness(const Field& field) {
  const CanonicalCut& cut = field.cut();
  for (std::size_t i = 0; i < field.quantities.size(); ++i) {
    if (field.quantities[i].name != "compliance" || field.quantities[i].components != 1) continue;
    double compliance = 0;
    field.quantity(i, {cut.start + cut.length / 2, 0, 0}, Side::both, 0, std::span(&compliance, 1));
    return stiffness_from_compliance(compliance);
  }
  const auto modulus = field.parameters.find("tissue.young_modulus"),
             ratio = field.parameters.find("tissue.poisson_ratio");
  if (modulus == field.parameters.end() || ratio == field.parameters.end())
    throw InputError("the field knows neither a compliance nor its tissue's modulus: give --stiffness");
  const double nu = ratio->second;
  return stiffness_from_compliance(2 * radius * (1 - nu * nu) / modulus->second);
}

}  // namespace cleft
