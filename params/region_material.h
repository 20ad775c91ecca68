// What a region of a body's tissue is made of.
#pragma once

#include <optional>
#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// Moduli that are not given are those of the case: tissue.young_modulus, tissue.poisson_ratio.
struct RegionMaterial {
  std::string name;
  std::optional<double> young_modulus = {};  ///< MPa
  std::optional<double> poisson_ratio = {};

  bool operator==(const RegionMaterial&) const = default;

  /// Of tissue that is made of it.
  Parameters::Tissue tissue_of(const Parameters& parameters) const {
    Parameters::Tissue tissue = parameters.tissue;
    tissue.young_modulus = young_modulus.value_or(tissue.young_modulus);
    tissue.poisson_ratio = poisson_ratio.value_or(tissue.poisson_ratio);
    return tissue;
  }
};

}  // namespace cleft
