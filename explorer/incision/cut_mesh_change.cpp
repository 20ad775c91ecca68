// The elementary changes of a CutMesh: splitting edges and faces, flipping, moving.
#include "base/error.h"
#include "explorer/incision/cut_mesh.h"

namespace cleft {

namespace {

/// How far along a -> b a place on that edge lies.
double part_of(const Vec3& place, const Vec3& a, const Vec3& b) {
  const double from = norm(place - a), to = norm(place - b);
  return from / (from + to);
}

/// s of a place on an edge between corners of a wall; `given` where the caller knows it to the last bit.
double s_between(double a, double b, double part, std::optional<double> given) {
  if (a == b) return a;
  if (given && (*given - a) * (*given - b) < 0) return *given;
  return (1 - part) * a + part * b;
}

}  // namespace

int CutMesh::split_edge(int t, int i, const Vec3& place, std::optional<double> s) {
  // Over neighbours and twins: all triangles on this edge. Where cuts meet there are more than four.
  std::vector<std::array<int, 2>> around{{t, i}};
  for (std::size_t k = 0; k < around.size(); ++k) {
    const auto visit = [&](int triangle, int edge) {
      for (const auto& [known, at] : around)
        if (known == triangle) return;
      around.push_back({triangle, edge});
    };
    const auto [current, edge] = around[k];
    const Triangle& c = triangles_[current];
    CLEFT_CHECK(c.neighbor[edge], !=, non_manifold);
    if (c.neighbor[edge] >= 0)
      visit(c.neighbor[edge], triangles_[c.neighbor[edge]].corner(c.vertex[(edge + 1) % 3]));
    if (c.sheet >= 0) visit(twin(current), twin_edge(edge));
  }
  const Vec3 start = position(triangles_[t].vertex[i]);
  const double part = part_of(place, start, position(triangles_[t].vertex[(i + 1) % 3]));
  std::vector<std::array<int, 3>> parted;
  const auto is_parted = [&](int triangle) {
    for (const auto& p : parted)
      if (p[0] == triangle) return true;
    return false;
  };
  int first = -1;
  for (const auto& [triangle, edge] : around) {
    if (is_parted(triangle)) continue;
    const bool same_way = position(triangles_[triangle].vertex[edge]) == start;
    const Vertex vertex = new_on_edge(triangle, edge, place, first < 0 || same_way ? part : 1 - part, s);
    const int m = split_pair(triangle, edge, place, parted);
    const int around_m = vertices_[m].triangle;
    vertices_[m] = vertex;
    vertices_[m].triangle = around_m;
    if (first < 0) first = m;
  }
  split_sheets(parted, part, s);
  return first;
}

CutMesh::Vertex CutMesh::new_on_edge(int t, int i, const Vec3& place, double part,
                                     std::optional<double> s) const {
  Vertex vertex{place, place, t};
  const int from = triangles_[t].vertex[i], to = triangles_[t].vertex[(i + 1) % 3];
  vertex.parents = {from, to, to};
  vertex.depth = (1 - part) * vertices_[from].depth + part * vertices_[to].depth;
  const int other = triangles_[t].neighbor[i];
  const bool other_is_wall = other >= 0 && triangles_[other].region != Region::skin;
  const bool is_wall = triangles_[t].region != Region::skin;
  if (!is_wall && !other_is_wall) return vertex;
  const int wall = is_wall ? t : other;
  const Region region = triangles_[wall].region;
  const int a = triangles_[wall].corner(from), b = triangles_[wall].corner(to);
  const bool left = region == Region::left_wall;
  if (!is_wall || (other >= 0 && !other_is_wall))
    vertex.kind = left ? VertexKind::left_lip : VertexKind::right_lip;
  else if (other >= 0 && triangles_[other].region != region)
    vertex.kind = VertexKind::shared;
  else
    vertex.kind = left ? VertexKind::left_wall : VertexKind::right_wall;
  vertex.s = s_between(wall_s(wall, a), wall_s(wall, b), part, s);
  vertex.depth_fraction = (1 - part) * wall_depth_fraction(wall, a) + part * wall_depth_fraction(wall, b);
  vertex.cut = sheets_[triangles_[wall].sheet].cut;
  return vertex;
}

int CutMesh::split_pair(int t, int i, const Vec3& place, std::vector<std::array<int, 3>>& parted) {
  // (a, b, c) and (b, a, d) around the edge a b become (a, m, c), (m, b, c), (b, m, d), (m, a, d).
  const Triangle old = triangles_[t];
  const int other = old.neighbor[i];
  const int a = old.vertex[i], b = old.vertex[(i + 1) % 3], c = old.vertex[(i + 2) % 3];
  const int across_bc = old.neighbor[(i + 1) % 3], across_ca = old.neighbor[(i + 2) % 3];
  const int m = add_vertex({place, place, t});
  const int t2 = add_triangle({m, b, c}, old.region);
  parted.push_back({t, t2, i});
  edit(t) = {{a, m, c}, {boundary, t2, across_ca}, old.region, old.sheet};
  edit(t2).neighbor = {boundary, across_bc, t};
  if (across_bc >= 0) set_neighbor(across_bc, c, b, t2);
  const auto now_at = [&](int v, int before, int after) {  // skin stays with skin
    if (vertices_[v].triangle == before) edit_vertex(v).triangle = after;
  };
  now_at(b, t, t2);
  if (other == boundary) return m;

  const Triangle old2 = triangles_[other];
  const int j = old2.corner(b), d = old2.vertex[(j + 2) % 3];
  const int across_ad = old2.neighbor[(j + 1) % 3], across_db = old2.neighbor[(j + 2) % 3];
  const int t4 = add_triangle({m, a, d}, old2.region);
  parted.push_back({other, t4, j});
  edit(other) = {{b, m, d}, {t2, t4, across_db}, old2.region, old2.sheet};
  edit(t4).neighbor = {t, across_ad, other};
  if (across_ad >= 0) set_neighbor(across_ad, d, a, t4);
  edit(t).neighbor[0] = t4;
  edit(t2).neighbor[0] = other;
  now_at(a, other, t4);
  if (old.region != Region::skin && old2.region == Region::skin) vertices_[m].triangle = other;
  return m;
}

void CutMesh::split_sheets(const std::vector<std::array<int, 3>>& parted, double part,
                           std::optional<double> s) {
  // Left (a, b, c) has become (a, m, c) and, new, (m, b, c); right (b, m, c) and, new, (m, a, c).
  const Vec3 start = position(triangles_[parted[0][0]].vertex[0]);
  for (const auto& [left, new_left, i] : parted) {
    if (triangles_[left].region != Region::left_wall) continue;
    const int sheet = triangles_[left].sheet, right = sheets_[sheet].right;
    int new_right = -1;
    for (const auto& [t, fresh, edge] : parted)
      if (t == right) new_right = fresh;
    CLEFT_CHECK(new_right, >=, 0);
    rotate(right), rotate(new_right);
    const Sheet old = sheets_[sheet];
    const int a = i, b = (i + 1) % 3, c = (i + 2) % 3;
    const double along = position(triangles_[left].vertex[0]) == start ? part : 1 - part;
    const double s_m = s_between(old.s[a], old.s[b], along, s);
    const double depth_m = (1 - along) * old.depth_fraction[a] + along * old.depth_fraction[b];
    edit_sheet(sheet) = {left,
                         new_right,
                         old.cut,
                         {old.s[a], s_m, old.s[c]},
                         {old.depth_fraction[a], depth_m, old.depth_fraction[c]}};
    const int fresh = add_sheet({new_left,
                                 right,
                                 old.cut,
                                 {s_m, old.s[b], old.s[c]},
                                 {depth_m, old.depth_fraction[b], old.depth_fraction[c]}});
    edit(new_left).sheet = edit(right).sheet = fresh;
    edit(new_right).sheet = sheet;
  }
}

void CutMesh::rotate(int t) {
  Triangle& x = edit(t);
  x.vertex = {x.vertex[1], x.vertex[2], x.vertex[0]};
  x.neighbor = {x.neighbor[1], x.neighbor[2], x.neighbor[0]};
}

int CutMesh::split_face(int t, const Vec3& place) {
  const Triangle old = triangles_[t];
  CLEFT_CHECK((old.region == Region::skin), ==, true);
  const auto [a, b, c] = old.vertex;
  const int m = add_vertex({place, place, t});
  vertices_[m].parents = old.vertex;
  const int t2 = add_triangle({b, c, m}, old.region), t3 = add_triangle({c, a, m}, old.region);
  edit(t) = {{a, b, m}, {old.neighbor[0], t2, t3}, old.region};
  edit(t2).neighbor = {old.neighbor[1], t3, t};
  edit(t3).neighbor = {old.neighbor[2], t, t2};
  if (old.neighbor[1] >= 0) set_neighbor(old.neighbor[1], c, b, t2);
  if (old.neighbor[2] >= 0) set_neighbor(old.neighbor[2], a, c, t3);
  if (vertices_[c].triangle == t) edit_vertex(c).triangle = t2;
  return m;
}

void CutMesh::flip_edge(int t, int i) {
  // (a, b, c) and (b, a, d) become (a, d, c) and (d, b, c).
  const Triangle old = triangles_[t];
  const int other = old.neighbor[i];
  CLEFT_CHECK(other, >=, 0);
  const Triangle old2 = triangles_[other];
  const int a = old.vertex[i], b = old.vertex[(i + 1) % 3], c = old.vertex[(i + 2) % 3];
  const int j = old2.corner(b), d = old2.vertex[(j + 2) % 3];
  const int across_bc = old.neighbor[(i + 1) % 3], across_ca = old.neighbor[(i + 2) % 3];
  const int across_ad = old2.neighbor[(j + 1) % 3], across_db = old2.neighbor[(j + 2) % 3];
  edit(t) = {{a, d, c}, {across_ad, other, across_ca}, old.region};
  edit(other) = {{d, b, c}, {across_db, across_bc, t}, old.region};
  if (across_ad >= 0) set_neighbor(across_ad, d, a, t);
  if (across_bc >= 0) set_neighbor(across_bc, c, b, other);
  if (vertices_[b].triangle == t) edit_vertex(b).triangle = other;
  if (vertices_[a].triangle == other) edit_vertex(a).triangle = t;
}

void CutMesh::move_vertex(int v, const Vec3& place) {
  edit_vertex(v).position = place;
  for (const int t : fan(v)) edit(t);  // unchanged, but remembered: undoing the move changes them again
}

}  // namespace cleft
