// What `cleft cut` wrote as .vtp.
#pragma once

#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

struct CutFile {
  std::vector<Vec3> rest;          ///< position before the displacement
  std::vector<Vec3> displacement;  ///< mesh units
  std::vector<double> depth;       ///< mm below the skin
  std::vector<double> side;        ///< its sign: where the skin around the vertex lies in y, at rest
};

CutFile read_cut(const std::string& path);

}  // namespace cleft
