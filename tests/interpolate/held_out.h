// Fields compared with the simulation of a case that no study held.
#pragma once

#include <string>
#include <vector>

#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

/// Largest distances at any node and frame, over the case's largest displacement; and what the field says of
/// itself.
struct HeldOut {
  double error = 0;          ///< of the interpolated field, against the simulation's frames
  double against_field = 0;  ///< of the interpolated field, against the field that was fitted to them
  double nearest = 0;        ///< of the nearest case's field, against the frames
  double fit = 0;            ///< of the fitted field, against the frames
  double estimate = 0, interpolation_estimate = 0, outside = 0;
  double milliseconds = 0;  ///< that the interpolation took
};

/// All published cases of the folder `held`, with their snapshots, by a study that they are no part of.
std::vector<HeldOut> compare_held_out(const StudyInterpolator& study, const std::vector<StudyMember>& members,
                                      const std::string& held);

/// Of the values, the share of those that are at most `most`.
double share_within(const std::vector<double>& values, double most);

/// One number of each.
template <class Function>
std::vector<double> of_each(const std::vector<HeldOut>& list, const Function& function) {
  std::vector<double> values;
  for (const HeldOut& one : list) values.push_back(function(one));
  return values;
}

}  // namespace cleft
