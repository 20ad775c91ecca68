// Rigorous bounds of the errors of fields between the cases of a study.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace cleft {

/// Numbers by the names of their parameters.
using ParametersByName = std::map<std::string, double>;

/// Of a field between the cases, in the norm of the energy, (N mm)^1/2, by frames.
struct Certificate {
  ParametersByName values;
  std::string reference;       ///< the case whose moduli the bound is made with
  double most_over_error = 1;  ///< at most so many times the error is the bound
  double moved = 0;            ///< mm: by how much the field parts closed nodes, which were put together
  std::vector<double> length_cut, bound, size;
  std::vector<double> error;  ///< the error itself, if it was asked for
};

/// Writes the field at the nodes of the mesh that its case would have and lets `cleft residual` bound how far
/// it is from the solution: points of one mesh share one factor, that of the case of the study whose moduli
/// are nearest to all of them. Throws InputError where a bound does not apply, std::runtime_error if a
/// command fails. `progress` is called with the current step.
std::vector<Certificate> certificates(const std::string& study, const std::vector<ParametersByName>& points,
                                      bool solve, const std::function<void(const std::string&)>& progress);

}  // namespace cleft
