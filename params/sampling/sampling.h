// Sampling: from a study's variations to its cases. A method is one file in this folder, and two lines in
// sampling.cpp.
#pragma once

#include <string>
#include <vector>

#include "params/study.h"

namespace cleft {

constexpr std::size_t most_cases = 1'000'000;  ///< of a study

struct SamplingMethod {
  std::string name;
  std::vector<Case> (*sample)(const Study& study);
  bool draws;  ///< cases from ranges; otherwise variations give values
  /// Of a method that draws: sampling.level says how many; otherwise sampling.count and sampling.seed.
  bool levels = false;
  /// Cases are added by what those before them tell; the method draws the first ones.
  bool adapts = false;
};

/// Finds a method by name; throws InputError "<where>: unknown sampling method ...".
const SamplingMethod& find_sampling(const std::string& name, const std::string& where);

/// Names of the methods that draw, in quotes: "a" or "b".
std::string drawing_methods();

/// A uniform number in [0, 1) from 64 random bits; equal on all platforms, unlike the standard's
/// distributions.
double unit_fraction(std::uint64_t bits);

/// Sets the parameter to the value `part` of `whole` steps along its range, rounded to 12 digits, so that
/// differences of processors in the last bit do not change the case.
void set_drawn(Case& one, const Variation& variation, double part, double whole);

}  // namespace cleft
