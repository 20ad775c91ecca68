// The motion of one point while the cut grows, and that of the nearest node of the simulation.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "explorer/study/case_figures.h"
#include "explorer/study/raw_case.h"

namespace cleft {

struct Motion {
  std::array<Curve, 3> field;  ///< du, dv, dw over the length cut, mm
  std::array<Curve, 3> raw;    ///< of the node, at the frames; empty without the simulation
  std::optional<Vec3> node;    ///< position of the node at rest
  /// The field at the place of the node, to be compared with `raw`; empty without the simulation.
  std::array<Curve, 3> at_node;
};

/// `raw`: null without a simulation.
Motion motion_of(const Field& field, const Vec3& uvw, Side side, const RawCase* raw);

/// Columns t, du, dv, dw of the field; with a simulation at its frames, followed by those of the node and by
/// those of the field at the place of the node.
std::string motion_as_csv(const Field& field, const Vec3& uvw, Side side, const Motion& motion);

}  // namespace cleft
