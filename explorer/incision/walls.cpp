#include "explorer/incision/walls.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "explorer/incision/incision_tolerances.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

int add_below(CutMesh& mesh, int top, const Vec3& place, double s, double fraction, double depth, int cut) {
  return mesh.add_vertex(
      {place, place, -1, VertexKind::shared, s, fraction, cut, fraction * depth, {top, top, top}});
}

/// A corner of a wall's triangle.
struct WallCorner {
  int triangle, corner;
};

/// The next vertex of the wound below v in the wall of `cut` (-1: any) at its parameter s, made where the
/// wall has none; -1 at the bottom.
int below_in_wall(CutMesh& mesh, int v, int& cut, double& s) {
  for (const int t : mesh.fan(v)) {
    const CutMesh::Triangle& triangle = mesh.triangle(t);
    if (triangle.sheet < 0) continue;
    const CutMesh::Sheet& sheet = mesh.sheets()[triangle.sheet];
    const int i = triangle.corner(v), j = (i + 1) % 3, k = (i + 2) % 3;
    if (cut >= 0 && (sheet.cut != cut || mesh.wall_s(t, i) != s)) continue;
    const double own = mesh.wall_s(t, i), depth = mesh.wall_depth_fraction(t, i);
    for (const int corner : {j, k})
      if (mesh.wall_s(t, corner) == own && mesh.wall_depth_fraction(t, corner) > depth) {
        cut = sheet.cut, s = own;
        return triangle.vertex[corner];
      }
  }
  for (const int t : mesh.fan(v)) {
    const CutMesh::Triangle triangle = mesh.triangle(t);
    if (triangle.sheet < 0) continue;
    const CutMesh::Sheet& sheet = mesh.sheets()[triangle.sheet];
    const int i = triangle.corner(v), j = (i + 1) % 3, k = (i + 2) % 3;
    if (cut >= 0 && (sheet.cut != cut || mesh.wall_s(t, i) != s)) continue;
    const double own = mesh.wall_s(t, i), a = mesh.wall_s(t, j), b = mesh.wall_s(t, k);
    if ((own - a) * (own - b) >= 0) continue;
    const double part = (own - a) / (b - a);
    const double depth = (1 - part) * mesh.wall_depth_fraction(t, j) + part * mesh.wall_depth_fraction(t, k);
    if (!(depth > mesh.wall_depth_fraction(t, i))) continue;
    cut = sheet.cut, s = own;
    return mesh.split_edge(
        t, j, lerp(mesh.position(triangle.vertex[j]), mesh.position(triangle.vertex[k]), part), own);
  }
  return -1;
}

}  // namespace

Column hang_column(CutMesh& mesh, int top, const Vec3& down, double s, int cut, int rows) {
  Column column{{top}, {0}, s};
  for (int row = 1; row <= rows; ++row) {
    const double fraction = double(row) / rows;
    const Vec3 place = mesh.position(top) + fraction * down;
    column.vertex.push_back(add_below(mesh, top, place, s, fraction, norm(down), cut));
    column.depth_fraction.push_back(fraction);
  }
  return column;
}

Column wound_column(CutMesh& mesh, int top, const Vec3& down, double s, int cut, int rows,
                    const std::vector<int>& below) {
  const double depth = norm(down), spacing = depth / rows;
  Column column{{top}, {0}, s};
  int wall_cut = -1;
  double wall_s = 0, reached = 0;
  while (true) {
    const int v = column.vertex.back();
    int next = below_in_wall(mesh, v, wall_cut, wall_s);
    if (next < 0 && wall_cut >= 0) {  // where wounds cross the deeper one's wall goes on
      wall_cut = -1;
      next = below_in_wall(mesh, v, wall_cut, wall_s);
    }
    if (next < 0) break;
    const double step = norm(mesh.position(next) - mesh.position(v));
    const double left = depth - reached;
    if (left < step * Limits::ends_on_edge &&
        left < step - Limits::ends_before_row * spacing) {  // the blade ends on this edge
      const bool near_upper = left < Limits::ends_at_upper * step && column.size() > 1;
      if (near_upper) {
        column.opens = true;
        break;
      }
      const int t = mesh.any_triangle_with(v, next);
      CLEFT_CHECK(t, >=, 0);
      next = mesh.split_edge(
          t, mesh.triangle(t).corner(v),
          lerp(mesh.position(v), mesh.position(next), std::max(left / step, Limits::ends_at_upper)));
    }
    column.vertex.push_back(next);
    reached += step;
    if (reached >= depth - Limits::bottom_row * spacing) {
      column.opens = true;
      break;
    }
  }
  if (column.size() == 1)  // so close to a column that it has the same parameter
    throw InputError("the path meets a wound too close to a corner of its wall near " +
                     place_of(mesh.position(top)) + "; move it a little");
  column.first_new = column.size();
  for (std::size_t i = 1; i < column.size(); ++i)
    column.depth_fraction.push_back(
        std::min(1.0, norm(mesh.position(column.vertex[i]) - mesh.position(top)) / depth));
  if (column.opens) {
    column.depth_fraction.back() = 1;
    return column;
  }
  const int bottom = column.vertex.back();
  const double from = norm(mesh.position(bottom) - mesh.position(top));
  const int more = below.empty() ? std::max(1, static_cast<int>(std::lround((depth - from) / spacing)))
                                 : static_cast<int>(below.size());
  for (int i = 1; i <= more; ++i) {
    const double fraction = 1 + (from / depth - 1) * (1 - double(i) / more);
    const Vec3 place = lerp(mesh.position(bottom), mesh.position(top) + down, double(i) / more);
    column.vertex.push_back(below.empty() ? add_below(mesh, top, place, s, fraction, depth, cut)
                                          : below[i - 1]);
    column.depth_fraction.push_back(i == more ? 1 : fraction);
  }
  column.opens = !below.empty();
  return column;
}

void Sewing::add(const Column& p, const Column& q) {
  CLEFT_CHECK(can_stand(p, q), ==, true);
  if (std::find_first_of(p.vertex.begin() + 1, p.vertex.end(), q.vertex.begin() + 1, q.vertex.end()) !=
      p.vertex.end())
    throw InputError("the path comes back to the same place of a wound near " +
                     place_of(mesh_.position(q.vertex[0])) + "; lead it across, or away from it");
  p_ = p, q_ = q;
  along_p_.clear(), along_q_.clear();
  const std::size_t n = p.size() - 1, m = q.size() - 1;
  int before_left = -1, before_right = -1;
  first_ = static_cast<int>(mesh_.triangles().size());
  const auto both = [&](int left, int right, int from, int to) { mesh_.link(left, right, from, to); };
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    // The next rung goes down on the side that is less deep; edges between closed vertices are left out.
    bool down_p = j == m || (i < n && p.depth_fraction[i + 1] <= q.depth_fraction[j + 1]);
    if (p.opens && i + 1 == n && j < m) down_p = false;
    if (!p.opens && j + 1 == m && i < n) down_p = true;
    const int a = p.vertex[i], b = q.vertex[j], c = down_p ? p.vertex[i + 1] : q.vertex[j + 1];
    const int left = mesh_.add_triangle({a, b, c}, Region::left_wall),
              right = mesh_.add_triangle({a, c, b}, Region::right_wall);
    const int sheet = mesh_.add_sheet({left,
                                       right,
                                       cut_,
                                       {p.s, q.s, down_p ? p.s : q.s},
                                       {p.depth_fraction[i], q.depth_fraction[j],
                                        down_p ? p.depth_fraction[i + 1] : q.depth_fraction[j + 1]}});
    mesh_.edit(left).sheet = mesh_.edit(right).sheet = sheet;
    for (const int v : {a, b, c})
      if (mesh_.vertex(v).triangle < 0) mesh_.edit_vertex(v).triangle = left;
    if (before_left < 0) {
      both(left, right, a, b);
    } else {
      mesh_.link(before_left, left, b, a);
      mesh_.link(before_right, right, a, b);
    }
    if (down_p) {
      both(left, right, c, a);
      along_p_.push_back(left);
      ++i;
    } else {
      both(left, right, b, c);
      along_q_.push_back(left);
      ++j;
    }
    before_left = left, before_right = right;
  }
  both(before_left, before_right, q.vertex[m], p.vertex[n]);

  const int skin = mesh_.triangle_with(p.vertex[0], q.vertex[0]),
            other = mesh_.triangle_with(q.vertex[0], p.vertex[0]);
  if (skin < 0 || other < 0) {
    throw InputError("the path runs along the edge of the surface, or back along itself, near " +
                     place_of(mesh_.position(q.vertex[0])) + "; move it off that edge, or smooth it there");
  }
  sew(p.vertex[0], q.vertex[0], first_);
  sew_column(p.vertex, along_p_);
  for (const Column* column : {&p, &q})
    touched_vertices_.insert(touched_vertices_.end(), column->vertex.begin(), column->vertex.end());
}

void Sewing::sew(int v, int w, int t) {
  const CutMesh::Triangle& left = mesh_.triangle(t);
  const bool along = left.vertex[(left.corner(v) + 1) % 3] == w;
  const int x = along ? v : w, y = along ? w : v;  // t has the directed edge x -> y
  const int u = left.neighbor[left.corner(x)];
  // The pair that is there already: a has the directed edge v -> w, b has w -> v. On a boundary one is
  // missing.
  int a = -1, b = -1;
  for (const int around : mesh_.fan(v)) {
    if (around == t || around == u) continue;
    const CutMesh::Triangle& other = mesh_.triangle(around);
    const int i = other.corner(v);
    if (other.vertex[(i + 1) % 3] == w) a = around;
    if (other.vertex[(i + 2) % 3] == w) b = around;
  }
  if (a < 0 && b < 0) return;
  const auto meet = [&](int own, int other, int from, int to) {
    other < 0 ? mesh_.unlink(own, from, to) : mesh_.link(own, other, from, to);
  };
  meet(t, along ? b : a, x, y);
  meet(u, along ? a : b, y, x);
  for (const int seed : {t, u, a, b})
    if (seed >= 0) seeds_.push_back(seed);
}

void Sewing::sew_column(const std::vector<int>& column, const std::vector<int>& edges) {
  for (std::size_t i = 0; i + 1 < column.size(); ++i) sew(column[i], column[i + 1], edges[i]);
}

void Sewing::join_end() { sew_column(q_.vertex, along_q_); }

void Sewing::open_at_boundary(bool at_start) {
  const std::vector<int>& column = at_start ? p_.vertex : q_.vertex;
  const std::vector<int>& edges = at_start ? along_p_ : along_q_;
  for (std::size_t i = 0; i + 1 < column.size(); ++i) {
    const int left = edges[i], right = mesh_.twin(left);
    const int x = at_start ? column[i + 1] : column[i], y = at_start ? column[i] : column[i + 1];
    mesh_.unlink(left, x, y);
    mesh_.unlink(right, y, x);
    seeds_.insert(seeds_.end(), {left, right});
  }
}

void Sewing::part_vertices() {
  std::sort(touched_vertices_.begin(), touched_vertices_.end());
  touched_vertices_.erase(std::unique(touched_vertices_.begin(), touched_vertices_.end()),
                          touched_vertices_.end());
  for (const int v : touched_vertices_) part(v);
  touched_vertices_.clear();
  seeds_.clear();
}

void Sewing::part(int v) {
  std::vector<int>
      fans;  // a triangle of each; those with the sheet's left layer come first and keep the number
  for (const bool left : {true, false})
    for (const int seed : seeds_)
      if ((mesh_.triangle(seed).region == Region::left_wall) == left && mesh_.triangle(seed).corner(v) >= 0)
        fans.push_back(seed);
  const CutMesh::Vertex before = mesh_.vertex(v);
  std::vector<int> done;
  for (const int seed : fans) {
    if (std::find(done.begin(), done.end(), seed) != done.end()) continue;
    const std::vector<int> fan = mesh_.fan(v, seed);
    const int name = done.empty() ? v : mesh_.add_vertex(before);
    if (name != v) mesh_.edit_vertex(name).parents = {v, v, v};
    done.insert(done.end(), fan.begin(), fan.end());
    if (name != v)
      for (const int t : fan) {
        CutMesh::Triangle& triangle = mesh_.edit(t);
        triangle.vertex[triangle.corner(v)] = name;
      }
    describe(name, fan);
  }
}

void Sewing::describe(int v, const std::vector<int>& fan) {
  const auto skin =
      std::find_if(fan.begin(), fan.end(), [&](int t) { return mesh_.triangle(t).region == Region::skin; });
  CutMesh::Vertex& vertex = mesh_.edit_vertex(v);
  vertex.triangle = skin == fan.end() ? fan.front() : *skin;
  if (vertex.cut != cut_ || (vertex.s != p_.s && vertex.s != q_.s)) return;  // another wound's vertex
  bool left = false, right = false;
  for (const int t : fan) {
    const CutMesh::Triangle& triangle = mesh_.triangle(t);
    if (triangle.sheet < 0 || mesh_.sheets()[triangle.sheet].cut != cut_) continue;
    (triangle.region == Region::left_wall ? left : right) = true;
  }
  const bool lip = vertex.depth_fraction == 0;
  if (left && !right) vertex.kind = lip ? VertexKind::left_lip : VertexKind::left_wall;
  if (right && !left) vertex.kind = lip ? VertexKind::right_lip : VertexKind::right_wall;
}

Sewing::Lips Sewing::lips_at_start(int sheet) const {
  return {mesh_.triangle(sheet).vertex[0], mesh_.triangle(mesh_.twin(sheet)).vertex[0]};
}

Sewing::Lips Sewing::lips_at_end(int sheet) const {
  return {mesh_.triangle(sheet).vertex[1], mesh_.triangle(mesh_.twin(sheet)).vertex[2]};
}

}  // namespace cleft
