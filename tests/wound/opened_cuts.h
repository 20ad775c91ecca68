// Straight cuts in a flat mesh that is refined along them, to be replayed.
#pragma once

#include <memory>
#include <vector>

#include "explorer/wound/wound.h"
#include "tests/incision/meshes.h"

namespace cleft::testing {

inline std::vector<Vec3> line(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y1, 0}};
}

/// One after the other. The wounds need it.
struct Made {
  CutMesh mesh{grid(60, 40, -60.3, -40.1, 2)};
  std::vector<std::unique_ptr<Incision>> cuts;

  std::vector<Wound> open(const VaryingField& field, const std::vector<std::vector<Vec3>>& paths) {
    for (const auto& path : paths) {
      cuts.push_back(std::make_unique<Incision>(mesh, path_through(path, up, 3), IncisionOptions{}));
      cuts.back()->advance_to(cuts.back()->path().length());
    }
    std::vector<Wound> opened;
    opened.reserve(cuts.size());
    for (const auto& cut : cuts) opened.emplace_back(*cut, field, 1);
    return opened;
  }
};

}  // namespace cleft::testing
