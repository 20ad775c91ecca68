// Nodes at the same place.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sets.h"
#include "encoder/import/series.h"

namespace cleft {

using Groups = std::vector<std::vector<std::int32_t>>;

/// Groups of two or more points closer than `tolerance` to another of the group; each ascending, by their
/// first.
Groups coincident_groups(const std::vector<Vec3>& points, double tolerance);

/// Faces of a crack in the skin of a body: flat cells that lie in the break, and hang together with others on
/// their side of it.
class FacesInBreak {
 public:
  /// `doubled`: whether a node is at one place with another.
  FacesInBreak(const SourceMesh& mesh, const std::vector<char>& doubled)
      : mesh_(mesh), doubled_(doubled), together_(mesh.points.size()) {}

  /// Whether a cell is such a face: its corners are at these distances from the break, where those of at most
  /// `near` are in it. If so it is kept.
  bool take(std::size_t cell, const std::vector<double>& distances, double near);

  /// Gives the nodes that have no side (0) that of those with which they hang together: -1 or 1.
  void spread(std::vector<double>& side);

 private:
  const SourceMesh& mesh_;
  const std::vector<char>& doubled_;
  std::vector<std::size_t> cells_;
  Sets together_;
};

/// Whether the mesh is unwelded: (nearly) each cell has its own nodes, so that most nodes have coincident
/// ones.
bool is_unwelded(const SourceMesh& mesh, const Groups& groups);

/// Merges coincident nodes whose values agree in all fields and frames, up to rounding. Returns the number of
/// nodes that were removed.
std::size_t weld(ImportedSeries& series, const Groups& groups);

}  // namespace cleft
