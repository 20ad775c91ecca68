// From a snapshot to its field: the fit and its error report. Paper, sections 3.2 and 3.3.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct EncodeOptions {
  /// Along u, v (both sides together), w and t. A series of fewer frames gets as many control points in t as
  /// frames.
  std::array<int, 4> control_points = {26, 16, 9, 16};
};

/// Fits cubic B-splines in (u, v, w, t) with a break across v = 0 to the displacements from frame 0, by
/// regularised least squares. The system is a Kronecker product of one problem in t and one in space, solved
/// one after the other. The field's report holds the errors of the field as it will be stored. Throws
/// InputError where the snapshot holds fewer than two frames or a mesh that v = 0 does not divide.
Field encode(const SnapshotReader& reader, const EncodeOptions& options,
             const std::function<void(const std::string&)>& progress);

/// Errors of a field against the snapshot it stands for, at every node and frame.
FitReport measure(const Field& field, const SnapshotReader& reader);

}  // namespace cleft
