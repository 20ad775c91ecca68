#include "explorer/incision/cut_mesh.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

struct HalfEdge {
  int low, high, opposite, triangle, edge;
  bool forward;
};

double distance_to_line(const Vec3& x, const Vec3& a, const Vec3& b) {
  return norm(cross(x - a, b - a)) / norm(b - a);
}

}  // namespace

CutMesh::CutMesh(const SurfaceMesh& surface) {
  const int count = static_cast<int>(surface.points.size());
  vertices_.reserve(2 * surface.points.size());
  for (const Vec3& p : surface.points) vertices_.push_back({p, p, -1});
  triangles_.reserve(2 * surface.triangles.size());
  std::vector<HalfEdge> edges;
  edges.reserve(3 * surface.triangles.size());
  std::vector<int> degree(surface.points.size());
  for (const auto& corners : surface.triangles) {
    const int t = static_cast<int>(triangles_.size());
    triangles_.push_back({corners, {boundary, boundary, boundary}});
    for (int i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      if (a < 0 || a >= count || a == b)
        throw InputError("triangle " + std::to_string(t) + " of the mesh names vertex " + std::to_string(a) +
                         " twice or outside 0 .. " + std::to_string(count - 1));
      edges.push_back({std::min(a, b), std::max(a, b), corners[(i + 2) % 3], t, i, a < b});
      vertices_[a].triangle = t;
      ++degree[a];
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    // Two triangles back to back with the same corners are no surface either.
    const bool regular = end - i == 2 && edges[i].forward != edges[i + 1].forward &&
                         edges[i].opposite != edges[i + 1].opposite;
    for (std::size_t k = i; k < end; ++k)
      if (end - i > 1)
        triangles_[edges[k].triangle].neighbor[edges[k].edge] =
            regular ? edges[i + i + 1 - k].triangle : non_manifold;
    i = end;
  }
  bow_tie_.assign(surface.points.size(), false);
  for (int v = 0; v < count; ++v) {
    if (degree[v] == 0) continue;
    try {
      bow_tie_[v] = static_cast<int>(skin_fan(v).size()) != degree[v];
    } catch (const InputError&) {  // the edges tell already
    }
  }
}

SurfaceMesh CutMesh::surface() const {
  SurfaceMesh result;
  for (const Vertex& v : vertices_) result.points.push_back(v.position);
  for (const Triangle& t : triangles_) result.triangles.push_back(t.vertex);
  return result;
}

void CutMesh::report_non_manifold(int v) const {
  const Vec3& p = position(v);
  throw InputError("the mesh is not a manifold near (" + shortest(p.x) + ", " + shortest(p.y) + ", " +
                   shortest(p.z) + "), where the path meets it; repair the mesh there, or move the path");
}

std::vector<int> CutMesh::skin_fan(int v) const {
  if (v < static_cast<int>(bow_tie_.size()) && bow_tie_[v]) report_non_manifold(v);
  std::vector<int> fan;
  const int first = vertices_[v].triangle;
  CLEFT_CHECK(first, >=, 0);
  const auto skin = [this, v](int t) {
    if (t == non_manifold) report_non_manifold(v);
    return t >= 0 && triangles_[t].region == Region::skin;
  };
  int t = first;
  do {  // counter-clockwise: across the edge that ends in v
    fan.push_back(t);
    const int i = triangles_[t].corner(v);
    CLEFT_CHECK(i, >=, 0);
    t = triangles_[t].neighbor[(i + 2) % 3];
  } while (t != first && skin(t));
  if (t == first) return fan;
  const std::size_t counter_clockwise = fan.size();
  for (t = triangles_[first].neighbor[triangles_[first].corner(v)]; skin(t);
       t = triangles_[t].neighbor[triangles_[t].corner(v)])
    fan.push_back(t);
  std::reverse(fan.begin() + counter_clockwise, fan.end());
  std::rotate(fan.begin(), fan.begin() + counter_clockwise, fan.end());
  return fan;
}

bool CutMesh::on_boundary(int v) const {
  const Triangle& t = triangles_[skin_fan(v).front()];
  return t.neighbor[t.corner(v)] == boundary;
}

double CutMesh::room(int v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const int t : skin_fan(v)) {
    const int i = triangles_[t].corner(v);
    least = std::min(least, distance_to_line(position(v), position(triangles_[t].vertex[(i + 1) % 3]),
                                             position(triangles_[t].vertex[(i + 2) % 3])));
  }
  return least;
}

int CutMesh::triangle_with(int v, int w) const {
  for (const int t : skin_fan(v))
    if (triangles_[t].vertex[(triangles_[t].corner(v) + 1) % 3] == w) return t;
  return -1;
}

int CutMesh::split_edge(int t, int i, const Vec3& place) {
  // (a, b, c) and (b, a, d) around the edge a b become (a, m, c), (m, b, c), (b, m, d), (m, a, d).
  const int other = triangles_[t].neighbor[i];
  CLEFT_CHECK(other, !=, non_manifold);
  const Triangle old = triangles_[t];
  const int a = old.vertex[i], b = old.vertex[(i + 1) % 3], c = old.vertex[(i + 2) % 3];
  const int across_bc = old.neighbor[(i + 1) % 3], across_ca = old.neighbor[(i + 2) % 3];
  const int m = add_vertex({place, place, t});
  const int t2 = add_triangle({m, b, c}, old.region);
  edit(t) = {{a, m, c}, {boundary, t2, across_ca}, old.region};
  edit(t2).neighbor = {boundary, across_bc, t};
  if (across_bc >= 0) set_neighbor(across_bc, c, b, t2);
  edit_vertex(b).triangle = t2;
  edit_vertex(a).triangle = edit_vertex(c).triangle = t;
  if (other == boundary) return m;

  const Triangle old2 = triangles_[other];
  const int j = old2.corner(b), d = old2.vertex[(j + 2) % 3];
  const int across_ad = old2.neighbor[(j + 1) % 3], across_db = old2.neighbor[(j + 2) % 3];
  const int t4 = add_triangle({m, a, d}, old2.region);
  edit(other) = {{b, m, d}, {t2, t4, across_db}, old2.region};
  edit(t4).neighbor = {t, across_ad, other};
  if (across_ad >= 0) set_neighbor(across_ad, d, a, t4);
  edit(t).neighbor[0] = t4;
  edit(t2).neighbor[0] = other;
  edit_vertex(d).triangle = other;
  return m;
}

int CutMesh::split_face(int t, const Vec3& place) {
  const Triangle old = triangles_[t];
  const auto [a, b, c] = old.vertex;
  const int m = add_vertex({place, place, t});
  const int t2 = add_triangle({b, c, m}, old.region), t3 = add_triangle({c, a, m}, old.region);
  edit(t) = {{a, b, m}, {old.neighbor[0], t2, t3}, old.region};
  edit(t2).neighbor = {old.neighbor[1], t3, t};
  edit(t3).neighbor = {old.neighbor[2], t, t2};
  if (old.neighbor[1] >= 0) set_neighbor(old.neighbor[1], c, b, t2);
  if (old.neighbor[2] >= 0) set_neighbor(old.neighbor[2], a, c, t3);
  edit_vertex(a).triangle = edit_vertex(b).triangle = t;
  edit_vertex(c).triangle = t2;
  return m;
}

void CutMesh::set_neighbor(int t, int from, int to, int neighbor) {
  const int i = triangles_[t].corner(from);
  CLEFT_CHECK(i, >=, 0);
  CLEFT_CHECK(triangles_[t].vertex[(i + 1) % 3], ==, to);
  edit(t).neighbor[i] = neighbor;
}

int CutMesh::add_vertex(const Vertex& vertex) {
  vertices_.push_back(vertex);
  return static_cast<int>(vertices_.size()) - 1;
}

int CutMesh::add_triangle(const std::array<int, 3>& vertex, Region region) {
  triangles_.push_back({vertex, {boundary, boundary, boundary}, region});
  return static_cast<int>(triangles_.size()) - 1;
}

CutMesh::Vertex& CutMesh::edit_vertex(int v) {
  if (recording_ && v < static_cast<int>(marked_vertices_)) old_vertices_.push_back({v, vertices_[v]});
  return vertices_[v];
}

CutMesh::Triangle& CutMesh::edit(int t) {
  if (recording_ && t < static_cast<int>(marked_triangles_)) old_triangles_.push_back({t, triangles_[t]});
  return triangles_[t];
}

void CutMesh::link(int a, int b, int from, int to) {
  set_neighbor(a, from, to, b);
  set_neighbor(b, to, from, a);
}

void CutMesh::unlink(int t, int from, int to) { set_neighbor(t, from, to, boundary); }

void CutMesh::mark() {
  recording_ = true;
  marked_triangles_ = triangles_.size();
  marked_vertices_ = vertices_.size();
  old_triangles_.clear();
  old_vertices_.clear();
}

void CutMesh::roll_back() {
  for (; !old_triangles_.empty(); old_triangles_.pop_back())
    triangles_[old_triangles_.back().first] = old_triangles_.back().second;
  for (; !old_vertices_.empty(); old_vertices_.pop_back())
    vertices_[old_vertices_.back().first] = old_vertices_.back().second;
  triangles_.resize(marked_triangles_);
  vertices_.resize(marked_vertices_);
}

}  // namespace cleft
