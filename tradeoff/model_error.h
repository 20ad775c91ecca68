// What small strains make wrong: a case with small and with finite strains, in one coarse mesh.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "params/parameters/parameters.h"
#include "tradeoff/samples.h"

namespace cleft {

/// A simulation's nodes, and processor seconds to solve and encode it.
struct ChainCost {
  double nodes, seconds;
};

struct ModelError {
  Samples error;                   ///< opening, small strains less finite ones, over the latter's largest one
  double ratio;                    ///< largest opening, of finite strains over that of small ones
  std::vector<ChainCost> finite;   ///< of coarse meshes with finite strains, the coarsest first
  double small_rise, finite_rise;  ///< mm: how far a lip rises above the skin
};

/// Takes seconds. `parameters`: of a straight cut, with either model; the finite one has the geometric
/// stiffness of the tension in any case. Throws InputError if the finite model does not have what else the
/// case asks for, std::runtime_error if it has no solution.
ModelError model_error(const Parameters& parameters, const std::string& work,
                       const std::function<void(const std::string&)>& progress);

}  // namespace cleft
