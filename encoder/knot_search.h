// Which rung of a ladder of knots is fine enough, as fits of single frames tell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// Index of the first rung whose fits in space of a few frames are off by no more than `limit` (mm) at any
/// node, or, where no rung's are, by more at a few nodes only; the rungs' number where there is none either.
/// Rungs are nested, and are taken to become better.
std::size_t first_rung_within(double limit, const std::vector<Rung>& rungs, const Series& series,
                              const Parametrization& parametrization,
                              const std::function<void(const std::string&)>& progress);

}  // namespace cleft
