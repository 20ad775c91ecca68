// The unit of a mesh file, which the file does not tell: guessed from the size of the mesh.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

struct LengthUnit {
  std::string name;
  double mm;  ///< in one of it
};

/// mm, cm, dm, m, in.
const std::vector<LengthUnit>& length_units();

/// mm in the unit that a word names: "dm", or a number of mm. Throws InputError.
double mm_of_unit(const std::string& word);
/// "dm" for 100; "45 mm" where no name fits.
std::string name_of_unit(double mm);

/// The longest edge of the box around the mesh, in its units.
double extent_of(const SurfaceMesh& mesh);

/// Whether fields of cuts `cut_length` mm long open cuts of sensible size in a mesh `extent` mm long.
bool is_sensible_extent(double extent, double cut_length);
/// mm: 1 if the extent is sensible in mm; else of the unit in which it is nearest to some cut lengths.
double guessed_unit(double extent, double cut_length);

/// A sentence where the size of a mesh, `extent` of its units of `scale` mm, is not sensible, with the unit
/// in which it would be; else empty. Throws InputError where it is absurd.
std::string doubt_of_size(double extent, double scale, double cut_length);

}  // namespace cleft
