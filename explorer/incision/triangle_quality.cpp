#include "explorer/incision/triangle_quality.h"

#include <algorithm>

namespace cleft {

double smallest_radius_ratio(const CutMesh& mesh) {
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (mesh.triangles()[t].region == Region::skin)
      least = std::min(least, radius_ratio(mesh, static_cast<int>(t)));
  return least;
}

double smallest_given_radius_ratio(const CutMesh& mesh) {
  const auto given = [&](int v) {
    const CutMesh::Vertex& x = mesh.vertex(v);
    return x.parents[0] < 0 && x.cut < 0 && x.original == x.position;
  };
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto& v = mesh.triangles()[t].vertex;
    if (given(v[0]) && given(v[1]) && given(v[2]))
      least = std::min(least, radius_ratio(mesh, static_cast<int>(t)));
  }
  return least;
}

}  // namespace cleft
