// The effect of each parameter of a study on a figure of its cases.
#pragma once

#include <string>
#include <vector>

namespace cleft {

struct Tornado {
  /// The figure at the least and the greatest value of a parameter, all others in the middle.
  struct Bar {
    std::string parameter;
    double least = 0, greatest = 0;        ///< values of the parameter
    double at_least = 0, at_greatest = 0;  ///< the figure there
  };
  std::vector<Bar> bars;   ///< the widest first
  double middle = 0;       ///< the figure with all parameters in the middle
  double explained = 0;    ///< share of the figure's variance that the fit explains
  bool logarithms = true;  ///< a power law was fitted; else a plane
};

/// Least squares over all cases: a power law if all numbers are positive, else a plane. rows[i][k]: value of
/// parameter k in case i. Throws InputError if the cases do not determine it.
Tornado tornado_of(const std::vector<std::string>& parameters, const std::vector<std::vector<double>>& rows,
                   const std::vector<double>& figures);

}  // namespace cleft
