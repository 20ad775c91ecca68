// The motion of one point while the cut grows, and of the simulation's node beside it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "explorer/study/case_figures.h"
#include "explorer/study/raw_case.h"

namespace cleft {

struct Motion {
  std::array<Curve, 3> field;  ///< du, dv, dw over the length cut, mm
  std::array<Curve, 3> raw;    ///< of the node, at the frames; empty where the simulation is not there
  std::optional<Vec3> node;    ///< where that is at rest
};

/// `raw`: null where there is none.
Motion motion_of(const Field& field, const Vec3& uvw, Side side, const RawCase* raw);

/// Columns t, du, dv, dw of the field, at the frames where the simulation is there; then its node's too.
std::string motion_as_csv(const Field& field, const Vec3& uvw, Side side, const Motion& motion);

}  // namespace cleft
