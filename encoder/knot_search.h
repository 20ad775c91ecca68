// The search for a sufficient rung of the ladder of knots, by fits of single frames.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encoder/fit_store.h"
#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// Index of the first rung whose fits in space of a few frames have residuals of at most `limit`, mm, at all
/// nodes, or, if there is no such rung, at all but a few nodes; if there is none, of one that leaves
/// hardly more in the last frame than the last. Rungs are nested and assumed to improve.
std::size_t sufficient_rung(double limit, const std::vector<Rung>& rungs, const Series& series,
                            FitStore& store, const std::function<void(const std::string&)>& progress);

}  // namespace cleft
