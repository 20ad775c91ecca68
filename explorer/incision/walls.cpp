#include "explorer/incision/walls.h"

#include "base/error.h"

namespace cleft {

void Walls::add_column(CutMesh& mesh, int lip, const Vec3& down, double s) {
  Column column;
  column.left.push_back(lip);
  for (int row = 1; row <= rows_; ++row) {
    const double fraction = double(row) / rows_;
    const Vec3 place = mesh.position(lip) + fraction * down;
    column.left.push_back(mesh.add_vertex({place, place, -1, VertexKind::shared, s, fraction}));
  }
  column.right = column.left;
  columns_.push_back(std::move(column));
}

void Walls::open_last_column(CutMesh& mesh, int right_lip) {
  Column& column = columns_.back();
  CLEFT_CHECK(column.open, ==, false);
  column.open = true;
  column.right[0] = right_lip;
  for (int row = 1; row < rows_; ++row) {
    CutMesh::Vertex copy = mesh.vertex(column.left[row]);
    copy.kind = VertexKind::right_wall;
    mesh.edit_vertex(column.left[row]).kind = VertexKind::left_wall;
    column.right[row] = mesh.add_vertex(copy);
  }
  if (segments_.empty() || segments_.back().first_column + 2 != columns()) return;
  // The sheets so far were joined along this column: part them.
  const Segment& segment = segments_.back();
  const int side = segment.falling ? 0 : 1;  // which of a quad's triangles has the later column's edge
  for (int row = 0; row < rows_; ++row) {
    const int left = triangle(segment, row, Region::left_wall, side);
    const int right = triangle(segment, row, Region::right_wall, side);
    mesh.unlink(left, column.left[row], column.left[row + 1]);
    mesh.unlink(right, column.left[row + 1], column.left[row]);
  }
  for (int row = 0; row < rows_; ++row)
    for (int which = 0; which < 2; ++which) {
      const int t = triangle(segment, row, Region::right_wall, which);
      for (int& v : mesh.edit(t).vertex)
        for (int r = row; r <= row + 1; ++r)
          if (v == column.left[r]) v = column.right[r];
    }
  for (int row = 1; row < rows_; ++row) {
    mesh.edit_vertex(column.left[row]).triangle = triangle(segment, row, Region::left_wall, side);
    mesh.edit_vertex(column.right[row]).triangle = triangle(segment, row, Region::right_wall, side);
  }
}

void Walls::add_segment(CutMesh& mesh, int left_skin, int right_skin) {
  const Column &p = columns_[columns() - 2], &q = columns_.back();
  CLEFT_CHECK((p.open || q.open), ==, true);
  // A diagonal from a closed column to the shared bottom would belong to both sheets.
  const Segment segment{static_cast<int>(mesh.triangles().size()), columns() - 2, p.open};
  for (int row = 0; row < rows_; ++row) {
    const int a = row, b = row + 1;
    const auto quad = [&](const std::vector<int>& from, const std::vector<int>& to, Region side) {
      // Seen from the wound. The first triangle has the upper edge, the second the lower one.
      if (segment.falling == (side == Region::left_wall)) {
        mesh.add_triangle({from[a], to[a], to[b]}, side);
        mesh.add_triangle({from[a], to[b], from[b]}, side);
      } else {
        mesh.add_triangle({from[a], to[a], from[b]}, side);
        mesh.add_triangle({to[a], to[b], from[b]}, side);
      }
    };
    quad(p.left, q.left, Region::left_wall);
    quad(q.right, p.right, Region::right_wall);
  }
  const bool joined = !segments_.empty() && segments_.back().first_column + 1 == segment.first_column;
  for (int row = 0; row < rows_; ++row) {
    for (const Region side : {Region::left_wall, Region::right_wall}) {
      const bool left = side == Region::left_wall;
      const std::vector<int>&pc = left ? p.left : p.right, &qc = left ? q.left : q.right;
      const int upper = triangle(segment, row, side, 0), lower = triangle(segment, row, side, 1);
      const int above = row > 0 ? triangle(segment, row - 1, side, 1) : left ? left_skin : right_skin;
      const auto link = [&](int t, int other, int from, int to) {  // mirrored on the right
        left ? mesh.link(t, other, from, to) : mesh.link(t, other, to, from);
      };
      link(upper, above, pc[row], qc[row]);
      segment.falling ? link(lower, upper, pc[row], qc[row + 1]) : link(upper, lower, qc[row], pc[row + 1]);
      if (joined) {
        const Segment& before = segments_.back();
        const int neighbor = triangle(before, row, side, before.falling ? 0 : 1);
        link(segment.falling ? lower : upper, neighbor, pc[row + 1], pc[row]);
      }
      for (const int v : {pc[row], pc[row + 1], qc[row], qc[row + 1]})
        if (mesh.vertex(v).triangle < 0) mesh.edit_vertex(v).triangle = upper;
      mesh.edit_vertex(pc[row + 1]).triangle = mesh.edit_vertex(qc[row + 1]).triangle = lower;
    }
    const auto both = [&](int which, int from, int to) {
      mesh.link(triangle(segment, row, Region::left_wall, which),
                triangle(segment, row, Region::right_wall, which), from, to);
    };
    if (row + 1 == rows_) both(1, q.left[rows_], p.left[rows_]);
    if (!q.open) both(segment.falling ? 0 : 1, q.left[row], q.left[row + 1]);
    if (!p.open) both(segment.falling ? 1 : 0, p.left[row + 1], p.left[row]);
  }
  segments_.push_back(segment);
}

int Walls::triangle(const Segment& segment, int row, Region side, int which) const {
  return segment.first_triangle + 4 * row + (side == Region::left_wall ? 0 : 2) + which;
}

Walls::Mark Walls::mark() const {
  return {columns_.size(), segments_.size(), !columns_.empty() && columns_.back().open};
}

void Walls::roll_back(const Mark& mark) {
  columns_.resize(mark.columns);
  segments_.resize(mark.segments);
  if (columns_.empty() || mark.last_was_open) return;
  columns_.back().open = false;
  columns_.back().right = columns_.back().left;
}

}  // namespace cleft
