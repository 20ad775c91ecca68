// What `cleft advise` chooses: mesh, patch, model, tolerance and what replays leave alone.
#pragma once

#include <optional>

#include "params/parameters/parameters.h"

namespace cleft {

/// By which elements grow away from the cut for an error of the opening. Linear ones that grow by 1.3 keep
/// 0.6 to 1 % of it however small they are at the cut; quadratic ones that grow by 1.6 keep less
/// (docs/accuracy.md).
constexpr double advised_grading(ElementOrder elements, double error) {
  return elements == ElementOrder::quadratic ? 1.6 : error < 0.02 ? 1.15 : 1.3;
}

struct Setting {
  double element_size = 0;          ///< mm, at the cut
  double margin = 0;                ///< mm of patch around the cut, on all four sides
  double tolerance = 0;             ///< of the encoder; 0: nothing is encoded
  double detail = 0;                ///< mm: vertices that never move by more stay at rest in replays
  std::optional<Model> model = {};  ///< none: the case's own
  ElementOrder elements = ElementOrder::linear;
  double grading = advised_grading(ElementOrder::linear, 1);  ///< by which elements grow away from the cut
};

Parameters applied(const Setting& setting, Parameters parameters);

}  // namespace cleft
