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
  const auto wall = [this](int t) { return t >= 0 && triangles_[t].region != Region::skin; };
  return wall(first.neighbor[first.corner(v)]) || wall(last.neighbor[(last.corner(v) + 2) % 3]);
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

CutMesh::Checkpoint CutMesh::checkpoint() const {
  return {triangles_.size(),    vertices_.size(),   sheets_.size(),
          triangle_log_.size(), vertex_log_.size(), sheet_log_.size()};
}

std::vector<int> CutMesh::changed_since(const Checkpoint& checkpoint) const {
  std::vector<int> changed;
  for (std::size_t i = checkpoint.triangle_log; i < triangle_log_.size(); ++i)
    if (triangle_log_[i].first < static_cast<int>(checkpoint.triangles))
      changed.push_back(triangle_log_[i].first);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (std::size_t t = checkpoint.triangles; t < triangles_.size(); ++t)
    changed.push_back(static_cast<int>(t));
  return changed;
}

int CutMesh::euler_change_since(const Checkpoint& checkpoint) const {
  // Two triangles to each edge but those of the boundary: E = (3 F + B) / 2.
  const auto free_edges = [](const Triangle& t) {
    return static_cast<int>(std::count(t.neighbor.begin(), t.neighbor.end(), boundary));
  };
  int free = 0;
  std::vector<int> seen;  // only a triangle's oldest value counts
  for (std::size_t i = checkpoint.triangle_log; i < triangle_log_.size(); ++i) {
    const auto& [t, old] = triangle_log_[i];
    if (t >= static_cast<int>(checkpoint.triangles)) continue;
    if (std::find(seen.begin(), seen.end(), t) != seen.end()) continue;
    seen.push_back(t);
    free += free_edges(triangles_[t]) - free_edges(old);
  }
  for (std::size_t t = checkpoint.triangles; t < triangles_.size(); ++t) free += free_edges(triangles_[t]);
  const int faces = static_cast<int>(triangles_.size() - checkpoint.triangles);
  const int vertices = static_cast<int>(vertices_.size() - checkpoint.vertices);
  return vertices - (3 * faces + free) / 2 + faces;
}

template <class T>
void CutMesh::undo(std::vector<T>& items, std::vector<std::pair<int, T>>& log, std::size_t count,
                   std::size_t entries, std::vector<T>* taken, std::vector<std::pair<int, T>>* taken_log) {
  for (; log.size() > entries; log.pop_back()) {
    auto& [i, old] = log.back();
    std::swap(items[i], old);
    if constexpr (std::is_same_v<T, Triangle>) note(i);
    if (taken_log) taken_log->push_back(log.back());
  }
  if constexpr (std::is_same_v<T, Triangle>)
    for (std::size_t i = count; i < items.size(); ++i) note(static_cast<int>(i));
  if (taken) taken->assign(items.begin() + static_cast<std::ptrdiff_t>(count), items.end());
  items.resize(count);
}

void CutMesh::roll_back(const Checkpoint& to) {
  undo<Triangle>(triangles_, triangle_log_, to.triangles, to.triangle_log, nullptr, nullptr);
  undo<Vertex>(vertices_, vertex_log_, to.vertices, to.vertex_log, nullptr, nullptr);
  undo<Sheet>(sheets_, sheet_log_, to.sheets, to.sheet_log, nullptr, nullptr);
}

CutMesh::Undone CutMesh::undo(const Checkpoint& to) {
  Undone undone;
  undo<Triangle>(triangles_, triangle_log_, to.triangles, to.triangle_log, &undone.triangles,
                 &undone.triangle_log);
  undo<Vertex>(vertices_, vertex_log_, to.vertices, to.vertex_log, &undone.vertices, &undone.vertex_log);
  undo<Sheet>(sheets_, sheet_log_, to.sheets, to.sheet_log, &undone.sheets, &undone.sheet_log);
  return undone;
}

void CutMesh::redo(const Undone& undone) {
  const auto again = [this](auto& items, auto& log, const auto& taken, const auto& taken_log) {
    items.insert(items.end(), taken.begin(), taken.end());
    for (auto entry = taken_log.rbegin(); entry != taken_log.rend(); ++entry) {
      log.push_back({entry->first, items[entry->first]});
      items[entry->first] = entry->second;
    }
  };
  const auto first = static_cast<int>(triangles_.size());
  again(triangles_, triangle_log_, undone.triangles, undone.triangle_log);
  again(vertices_, vertex_log_, undone.vertices, undone.vertex_log);
  again(sheets_, sheet_log_, undone.sheets, undone.sheet_log);
  for (int t = first; t < static_cast<int>(triangles_.size()); ++t) note(t);
  for (const auto& [t, value] : undone.triangle_log) note(t);
}

}  // namespace cleft
