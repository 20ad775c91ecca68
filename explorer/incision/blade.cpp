#include "explorer/incision/blade.h"

#include <algorithm>

#include "explorer/incision/predicates.h"

namespace cleft {

bool pierces(const CutMesh& mesh, int t, const PathFrame& frame) {
  const Vec3 head = frame.position + frame.outward;
  int sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int side = side_of_line(frame.position, head, mesh.position(mesh.triangle(t).vertex[i]),
                                  mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]));
    if (side < 0) return false;
    sum += side;
  }
  return sum > 0;
}

Vec3 piercing_point(const CutMesh& mesh, int t, const PathFrame& frame) {
  double part[3], sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]) - frame.position,
               b = mesh.position(mesh.triangle(t).vertex[(i + 2) % 3]) - frame.position;
    part[i] = std::max(0.0, dot(frame.outward, cross(a, b)));
    sum += part[i];
  }
  Vec3 place;
  for (int i = 0; i < 3; ++i) place += (part[i] / sum) * mesh.position(mesh.triangle(t).vertex[i]);
  return place;
}

int pierced(const CutMesh& mesh, const std::vector<int>& triangles, const PathFrame& frame) {
  for (const int t : triangles)
    if (pierces(mesh, t, frame)) return t;
  return -1;
}

}  // namespace cleft
