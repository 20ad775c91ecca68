// The cells of a volume mesh as a file has them, through VTK, whose types stay out of here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

struct FileCells {
  std::vector<Vec3> points;
  std::vector<int> types;               ///< VTK's number of each cell's type
  std::vector<std::vector<int>> nodes;  ///< of each cell
  std::vector<int> regions;             ///< by cell; empty if the file has no such array
  std::string regions_name;             ///< of that array
  std::vector<double> release;          ///< by point; empty if no name was given
};

/// Reads .vtu. `regions`: the array of the cells that numbers regions; none: the first of the names that gmsh
/// and meshio give it. `release`: an array of the points; none: not read. Throws FileError if the file is
/// missing or damaged, or lacks an array that was named.
FileCells read_cells(const std::string& path, const std::optional<std::string>& regions,
                     const std::optional<std::string>& release);

}  // namespace cleft
