// The file that says what the regions of a body are made of (docs/formats.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "params/region_material.h"

namespace cleft {

/// A section of the file: a material, and which cells are made of it.
struct RegionSection {
  RegionMaterial material;
  std::vector<int> regions;        ///< numbers in the cells of one's own mesh
  std::optional<double> to_depth;  ///< mm below the skin: of a layer below a surface, where it ends
  std::string where;               ///< for messages: "materials.toml, line 3"
};

/// What the faces of one's own mesh are, by their numbers.
struct FaceRegions {
  std::vector<int> skin, bone, free;
};

struct RegionFile {
  std::vector<RegionSection> sections;  ///< in the order of the file
  std::optional<FaceRegions> faces;     ///< [faces]
};

/// Throws InputError that names file, line and remedy.
RegionFile read_region_file(const std::string& path);

}  // namespace cleft
