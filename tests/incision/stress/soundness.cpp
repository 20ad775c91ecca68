#include "tests/incision/stress/soundness.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "explorer/incision/triangle_quality.h"

namespace cleft::stress {

Soundness::Soundness(const CutMesh& mesh) : mesh_(mesh), known_(mesh.triangles().size()) {
  for (std::size_t t = 0; t < known_.size(); ++t) {
    known_[t] = look(static_cast<int>(t));
    area_ += known_[t].area;
    boundary_ += known_[t].boundary;
    ++triangles_;
  }
  const std::vector<int> corners = corner_counts();
  torn_.resize(corners.size());
  for (std::size_t v = 0; v < corners.size(); ++v)
    torn_[v] = corners[v] > 0 && static_cast<int>(mesh.fan(static_cast<int>(v)).size()) != corners[v];
}

std::vector<int> Soundness::corner_counts() const {
  std::vector<int> corners(mesh_.vertices().size());
  for (const CutMesh::Triangle& t : mesh_.triangles())
    for (const int v : t.vertex) ++corners[v];
  return corners;
}

Soundness::Known Soundness::look(int t) const {
  const CutMesh::Triangle& x = mesh_.triangle(t);
  Known known;
  known.there = true;
  if (x.region == Region::skin)
    known.area = norm(cross(mesh_.position(x.vertex[1]) - mesh_.position(x.vertex[0]),
                            mesh_.position(x.vertex[2]) - mesh_.position(x.vertex[0]))) /
                 2;
  for (const int n : x.neighbor) known.boundary += n == CutMesh::boundary;
  return known;
}

std::string Soundness::local(int t) const {
  const CutMesh::Triangle& x = mesh_.triangle(t);
  const auto wrong = [&](const std::string& what) {
    std::ostringstream out;
    out << what << " at triangle " << t;
    return out.str();
  };
  for (int i = 0; i < 3; ++i) {
    const int a = x.vertex[i], b = x.vertex[(i + 1) % 3], n = x.neighbor[i];
    if (a == b) return wrong("two corners the same");
    const int home = mesh_.vertex(a).triangle;
    if (home < 0 || home >= static_cast<int>(mesh_.triangles().size()) || mesh_.triangle(home).corner(a) < 0)
      return wrong("a vertex whose triangle is not its own");
    if (x.region == Region::skin && mesh_.triangle(home).region != Region::skin)
      return wrong("a vertex of the skin that names a wall");
    if (n < 0) continue;
    if (n >= static_cast<int>(mesh_.triangles().size())) return wrong("a neighbour that is not there");
    const CutMesh::Triangle& y = mesh_.triangle(n);
    const int j = y.corner(b);
    if (j < 0 || y.vertex[(j + 1) % 3] != a || y.neighbor[j] != t) return wrong("a neighbour that disagrees");
  }
  if (x.region == Region::skin) {
    if (!(known_[t].area > 0)) return wrong("a triangle without area");
    return "";
  }
  const int twin = mesh_.twin(t);
  if (twin < 0 || mesh_.twin(twin) != t || mesh_.triangle(twin).region == x.region)
    return wrong("a wall without twin");
  for (int i = 0; i < 3; ++i)
    if (!(mesh_.position(x.vertex[i]) ==
          mesh_.position(mesh_.triangle(twin).vertex[CutMesh::twin_corner(i)])))
      return wrong("walls apart at rest");
  return "";
}

std::string Soundness::step() {
  known_.resize(std::max(known_.size(), mesh_.triangles().size()));
  for (const int t : mesh_.changed()) {
    if (t >= static_cast<int>(known_.size())) continue;  // added and taken away again
    Known& known = known_[t];
    area_ -= known.area, boundary_ -= known.boundary, triangles_ -= known.there;
    known = t < static_cast<int>(mesh_.triangles().size()) ? look(t) : Known{};
    area_ += known.area, boundary_ += known.boundary, triangles_ += known.there;
  }
  for (const int t : mesh_.changed()) {
    if (t >= static_cast<int>(mesh_.triangles().size())) continue;
    touched_.push_back(t);
    if (const std::string wrong = local(t); !wrong.empty()) return wrong;
  }
  return "";
}

int Soundness::worst_new_triangle() const {
  int worst = -1;
  for (const int t : touched_) {
    if (t >= static_cast<int>(mesh_.triangles().size()) || mesh_.triangle(t).region != Region::skin) continue;
    if (worst < 0 || radius_ratio(mesh_, t) < radius_ratio(mesh_, worst)) worst = t;
  }
  return worst;
}

int Soundness::euler() const {
  // Edges: two triangles to each but those of the boundary. Non-manifold edges of the input never change.
  return static_cast<int>(static_cast<long>(mesh_.vertices().size()) - (3 * triangles_ + boundary_) / 2 +
                          triangles_);
}

std::string Soundness::whole() const {
  double area = 0;
  long boundary = 0;
  for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
    const Known now = look(static_cast<int>(t));
    area += now.area, boundary += now.boundary;
    if (const std::string wrong = local(static_cast<int>(t)); !wrong.empty()) return wrong;
  }
  if (boundary != boundary_) return "the running count of the boundary is wrong";
  if (std::abs(area - area_) > 1e-9 * area) return "the running area is wrong";
  const std::vector<int> corners = corner_counts();
  for (std::size_t v = 0; v < corners.size(); ++v) {
    if (v < torn_.size() && (torn_[v] || mesh_.vertices()[v].triangle < 0)) continue;
    const std::size_t fan = mesh_.fan(static_cast<int>(v)).size();
    if (static_cast<int>(fan) == corners[v]) continue;
    std::ostringstream out;
    out << "vertex " << v << " has " << corners[v] << " triangles and a fan of " << fan;
    return out.str();
  }
  return "";
}

}  // namespace cleft::stress
