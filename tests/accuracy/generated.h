// Reference snapshots that no solver of this project made.
#pragma once

#include <string>

namespace cleft {

/// Hexahedra, no parameters, uneven times, a crack whose tip slows down: as `cleft import` writes other
/// programs' series.
void write_imported(const std::string& path);

/// Tetrahedra without a break: a pulse that travels through a block.
void write_uncut(const std::string& path);

}  // namespace cleft
