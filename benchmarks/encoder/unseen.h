// Errors of a fit where it saw nothing: between the nodes, and in frames that were kept from it.
#pragma once

#include <map>

#include "encoder/encode.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The largest error of the spline at the centroids of cells, where linear elements have the mean of their
/// nodes, at any frame, over the largest displacement.
double error_at_centroids(const Field& field, const Series& series, const Snapshot& s);

/// Encodes every other frame, and the last; the largest errors of the spline at the nodes in those left out,
/// by frame, over the largest displacement.
std::map<std::size_t, double> errors_unseen(const Series& series, const EncodeOptions& options);

}  // namespace cleft
