// When the fronts of several breaks begin to move, stop, or come to where breaks meet.
#pragma once

#include <vector>

#include "encoder/field/parametrization.h"

namespace cleft {

/// A frame at which displacements may turn abruptly: splines in time are continuous there, no more.
struct TimeKink {
  int frame = 0;
  double parameter = 0;  ///< its time, of the basis in time

  friend bool operator==(const TimeKink&, const TimeKink&) = default;
};

/// Of the front of one of several breaks: its own, and those of them that the others feel, where breaks meet
/// or it truly begins or stops rather than comes into the domain or leaves it.
struct FrontKinks {
  std::vector<TimeKink> own, felt;
};

/// `extent` as in a snapshot (encoder/field/field_source.h).
FrontKinks front_kinks(const FieldGeometry& geometry, const std::vector<double>& extent,
                       const std::vector<double>& times);

/// Whether a front stands where it begins for a tenth of the time and more.
bool waits(const TipPath& tip);

/// For one of several breaks: its own and those that it feels. Between two there are as many frames as a
/// cubic needs and one more: of several that are closer the first one counts.
std::vector<TimeKink> kinks_of_all(const std::vector<FrontKinks>& of_breaks, std::size_t own,
                                   std::size_t frames);

}  // namespace cleft
