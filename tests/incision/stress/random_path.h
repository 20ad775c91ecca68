// Paths of all kinds over a mesh, by the throw of a seeded die.
#pragma once

#include <optional>
#include <random>
#include <string>

#include "explorer/incision/scalpel_path.h"
#include "tests/incision/stress/surface_walker.h"

namespace cleft::stress {

enum class PathKind {
  straight,
  wavy,
  spiral,
  eight,
  zigzag,
  along_edges,
  near_edges,
  tiny,
  off_surface,
  across
};
constexpr int path_kinds = 10;
std::string name_of(PathKind kind);

/// None where the mesh has no room for it at the place thrown. `across` crosses `earlier` where there is one.
std::optional<ScalpelPath> random_path(const Ground& ground, PathKind kind,
                                       const std::optional<ScalpelPath>& earlier, std::mt19937_64& random);

}  // namespace cleft::stress
