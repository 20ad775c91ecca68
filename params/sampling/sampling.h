// How a study's variations become cases. A method is one file, and one line in sampling.cpp.
#pragma once

#include <string>
#include <vector>

#include "params/study.h"

namespace cleft {

using Sampling = std::vector<Case> (*)(const Study& study);

/// Finds a method by name; throws InputError "<where>: unknown sampling method ...".
Sampling find_sampling(const std::string& name, const std::string& where);

/// Every combination of the values; the last variation changes fastest.
std::vector<Case> sample_grid(const Study& study);

/// The n-th case takes the n-th value of every variation; the lists must be equally long.
std::vector<Case> sample_list(const Study& study);

}  // namespace cleft
