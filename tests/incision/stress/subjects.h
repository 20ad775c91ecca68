// The meshes that random cuts are made in.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft::stress {

struct Subject {
  std::string name;
  SurfaceMesh mesh;
  bool good = true;  ///< no defects, and no folds as sharp as an edge of a box
};

/// Plates, regular and jittered, hills, spheres, a torus, a cylinder; with `difficult` thin plates, ridges,
/// spikes, folded sheets, many outlines, and such shapes bent, sheared or drawn out, too.
std::vector<Subject> generated_subjects(bool difficult);

/// Hills of a million triangles.
Subject large_subject();

/// Those of .obj and .stl files below a folder, sorted; not good where their folder is called "defective".
std::vector<Subject> subjects_of(const std::string& folder);

}  // namespace cleft::stress
