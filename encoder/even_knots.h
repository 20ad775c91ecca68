// Knots at even distances for what does not follow a front, such as waves: as dense on each axis as the data
// need.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// A parametrisation that does not change with time. Where it follows a front, distances are as they are, not
/// as displacements grow.
std::shared_ptr<const Parametrization> standing(const Parametrization& parametrization);

/// The spans with which single frames of all `parts`, of one geometry, are off by at most `limit` at all
/// nodes; of those that the nodes determine, the best ones where there are none. One axis after another
/// becomes denser, the one that gains most. `time`: spans in time.
EvenSpans even_spans(const std::vector<Series>& parts, std::shared_ptr<const Parametrization> parametrization,
                     double limit, int time, const std::function<void(const std::string&)>& progress);

}  // namespace cleft
