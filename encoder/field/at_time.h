// Places that do not move with time.
#pragma once

#include <span>
#include <vector>

#include "encoder/field/place.h"

namespace cleft {

/// The same places at time t.
inline std::vector<Place> at_time(std::span<const Place> places, double t) {
  std::vector<Place> list(places.begin(), places.end());
  for (Place& place : list) place.t = t;
  return list;
}

}  // namespace cleft
