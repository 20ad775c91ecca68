#include "explorer/incision/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision_tolerances.h"

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
  for (const Vec3& p : surface.points) {
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!(farthest <= IncisionTolerances::largest_coordinate))
      throw InputError("point " + std::to_string(vertices_.size()) + " of the mesh is at " + place_of(p) +
                       "; a coordinate may be " + shortest(IncisionTolerances::largest_coordinate) +
                       " at most: remove the point, or give the mesh in larger units");
    vertices_.push_back({p, p, -1});
  }
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
  noted_.reserve(triangles_.capacity());
  noted_.resize(triangles_.size());
  bow_tie_.assign(surface.points.size(), false);
  for (int v = 0; v < count; ++v) {
    if (degree[v] == 0) continue;
    try {
      bow_tie_[v] = static_cast<int>(skin_fan(v).size()) != degree[v];
    } catch (const InputError&) {  // the edges tell already
    }
  }
}

std::string place_of(const Vec3& p) {
  return "(" + shortest(p.x) + ", " + shortest(p.y) + ", " + shortest(p.z) + ")";
}

int CutMesh::begin_cut() {
  const auto make_room = [](auto& items) {
    constexpr std::size_t least = 1 << 15;
    const std::size_t ahead = std::max(least, items.size() / 4);
    if (items.capacity() - items.size() < ahead) items.reserve(items.size() + 2 * ahead);
  };
  make_room(triangles_), make_room(vertices_), make_room(sheets_), make_room(noted_);
  make_room(triangle_log_), make_room(vertex_log_), make_room(sheet_log_), make_room(changed_);
  return cuts_++;
}

SurfaceMesh CutMesh::surface() const {
  SurfaceMesh result;
  for (const Vertex& v : vertices_) result.points.push_back(v.position);
  for (const Triangle& t : triangles_) result.triangles.push_back(t.vertex);
  return result;
}

void CutMesh::report_non_manifold(int v) const {
  throw InputError("the mesh is not a manifold near " + place_of(position(v)) +
                   ", where the path meets it; repair the mesh there, or move the path");
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

std::vector<int> CutMesh::fan(int v, int first) const {
  std::vector<int> fan;
  for (int t = first; t >= 0;) {  // counter-clockwise
    fan.push_back(t);
    t = triangles_[t].neighbor[(triangles_[t].corner(v) + 2) % 3];
    if (t == first) return fan;
  }
  if (first < 0) return fan;
  for (int t = first; (t = triangles_[t].neighbor[triangles_[t].corner(v)]) >= 0;) fan.push_back(t);
  return fan;
}

bool CutMesh::on_boundary(int v) const {
  const auto skin = skin_fan(v);
  const Triangle &first = triangles_[skin.front()], &last = triangles_[skin.back()];
  return first.neighbor[first.corner(v)] == boundary || last.neighbor[(last.corner(v) + 2) % 3] == boundary;
}

bool CutMesh::on_wound(int v) const {
  const auto skin = skin_fan(v);
  const Triangle &first = triangles_[skin.front()], &last = triangles_[skin.back()];
  return is_wall(first.neighbor[first.corner(v)]) || is_wall(last.neighbor[(last.corner(v) + 2) % 3]);
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

int CutMesh::any_triangle_with(int v, int w) const {
  for (const int t : fan(v))
    if (triangles_[t].vertex[(triangles_[t].corner(v) + 1) % 3] == w) return t;
  return -1;
}

int CutMesh::triangle_with(int v, int w) const {
  for (const int t : skin_fan(v))
    if (triangles_[t].vertex[(triangles_[t].corner(v) + 1) % 3] == w) return t;
  return -1;
}

int CutMesh::twin(int t) const {
  if (triangles_[t].sheet < 0) return -1;
  const Sheet& sheet = sheets_[triangles_[t].sheet];
  return sheet.left == t ? sheet.right : sheet.left;
}

double CutMesh::wall_s(int t, int i) const {
  const Sheet& sheet = sheets_[triangles_[t].sheet];
  return sheet.s[sheet.left == t ? i : twin_corner(i)];
}

double CutMesh::wall_depth_fraction(int t, int i) const {
  const Sheet& sheet = sheets_[triangles_[t].sheet];
  return sheet.depth_fraction[sheet.left == t ? i : twin_corner(i)];
}

int CutMesh::add_vertex(const Vertex& vertex) {
  vertices_.push_back(vertex);
  return static_cast<int>(vertices_.size()) - 1;
}

int CutMesh::add_triangle(const std::array<int, 3>& vertex, Region region) {
  triangles_.push_back({vertex, {boundary, boundary, boundary}, region});
  const int t = static_cast<int>(triangles_.size()) - 1;
  if (noted_.size() < triangles_.size()) noted_.push_back(0);
  note(t);
  return t;
}

int CutMesh::add_sheet(const Sheet& sheet) {
  sheets_.push_back(sheet);
  return static_cast<int>(sheets_.size()) - 1;
}

CutMesh::Vertex& CutMesh::edit_vertex(int v) {
  vertex_log_.push_back({v, vertices_[v]});
  return vertices_[v];
}

CutMesh::Triangle& CutMesh::edit(int t) {
  triangle_log_.push_back({t, triangles_[t]});
  note(t);
  return triangles_[t];
}

CutMesh::Sheet& CutMesh::edit_sheet(int i) {
  sheet_log_.push_back({i, sheets_[i]});
  return sheets_[i];
}

void CutMesh::note(int t) {
  if (noted_[t] == epoch_) return;
  noted_[t] = epoch_;
  changed_.push_back(t);
}

void CutMesh::forget_changes() {
  changed_.clear();
  ++epoch_;
}

void CutMesh::set_neighbor(int t, int from, int to, int neighbor) {
  const int i = triangles_[t].corner(from);
  CLEFT_CHECK(i, >=, 0);
  CLEFT_CHECK(triangles_[t].vertex[(i + 1) % 3], ==, to);
  edit(t).neighbor[i] = neighbor;
}

void CutMesh::link(int a, int b, int from, int to) {
  set_neighbor(a, from, to, b);
  set_neighbor(b, to, from, a);
}

void CutMesh::unlink(int t, int from, int to) { set_neighbor(t, from, to, boundary); }

}  // namespace cleft
