// --scale and --bone, alike in all commands that cut a surface mesh.
#pragma once

#include <string>

#include "base/command/command.h"

namespace cleft {

/// `scale`: mm in a unit of the mesh and of all that is given in its units.
inline Option* add_scale(CommandLine& app, double& scale) {
  return app.add_option("--scale", scale, "mm in a unit of the mesh, its paths and its bone")
      ->check(above(0))
      ->capture_default_str();
}

inline Option* add_bone(CommandLine& app, std::string& bone) {
  return app.add_option("--bone", bone,
                        "the surface of the bone below the mesh, in its units: of families of fields");
}

}  // namespace cleft
