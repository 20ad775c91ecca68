// A cut that winds over hills, for the time of its steps: one triangle crossed, with its column of walls.
#pragma once

#include <vector>

#include "explorer/incision/incision.h"

namespace cleft {

/// 2 squares x squares triangles about the origin, whose squares are 1 wide however many there are: a path
/// meets them at one scale.
SurfaceMesh hills(int squares);

/// 60 long and 2 deep, beginning elsewhere for every number.
ScalpelPath winding(int number);

class WindingCut {
 public:
  /// Cuts once, and takes it back, to know where the steps end.
  WindingCut(CutMesh& mesh, const ScalpelPath& path);

  std::size_t steps() const { return stops_.size() - 1; }
  /// Cuts, and takes it back; appends the microseconds of every step.
  void time(std::vector<double>& microseconds) const;

 private:
  CutMesh& mesh_;
  ScalpelPath path_;
  std::vector<double> stops_;
};

}  // namespace cleft
