// What splines leave at the nodes, coded.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "encoder/field/encoded.h"
#include "encoder/series.h"

namespace cleft {

/// Ranges of nodes that are worked on at a time.
inline constexpr std::size_t nodes_at_once = CodedResidual::most_nodes;

/// The spline at the nodes.
std::vector<Vec3> spline_at(const Field& field, std::span<const Sample> nodes, double t);

/// What a spline leaves of data at nodes first .. first + count - 1 in a frame: count x components.
using Left = std::function<Eigen::MatrixXd(std::size_t frame, std::size_t first, std::size_t count)>;

/// `kind` tells quantum, nodes, frames, components and the first frame. Sets `largest` to the largest norm
/// (norms_of) of what field and residual together then leave at any node and frame.
CodedResidual code_residual(CodedResidual kind, const Left& left, double& largest);

}  // namespace cleft
