// The walls of the wound: two sheets of triangles that reach down from the lips, joined at the bottom and at
// the closed ends. Paper, section 3.4. Columns are appended as the blade advances.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

class Walls {
 public:
  explicit Walls(int rows) : rows_(rows) {}

  int columns() const { return static_cast<int>(columns_.size()); }
  int rows() const { return rows_; }

  /// Vertices below `lip` along `down` (whose length is the depth), rows + 1 with the lip's own.
  void add_column(CutMesh& mesh, int lip, const Vec3& down, double s);

  /// Parts the last column into a left and a right one; `right_lip` is the lip's right copy.
  void open_last_column(CutMesh& mesh, int right_lip);

  /// The two sheets between the last two columns, joined to the skin triangles beside the lips and to the
  /// sheets before them. Of the two columns at least one must be open.
  void add_segment(CutMesh& mesh, int left_skin, int right_skin);

  /// Takes back what was added since `columns` columns and `segments` segments stood; the last column is
  /// closed again where it was.
  struct Mark {
    std::size_t columns, segments;
    bool last_was_open;
  };
  Mark mark() const;
  void roll_back(const Mark& mark);

 private:
  struct Column {
    std::vector<int> left, right;  // row 0 is the lip; the bottom row is shared
    bool open = false;
  };
  struct Segment {
    int first_triangle, first_column;
    bool falling;  // the diagonal goes from the earlier column down to the later one
  };
  int triangle(const Segment& segment, int row, Region side, int which) const;

  int rows_;
  std::vector<Column> columns_;
  std::vector<Segment> segments_;
};

}  // namespace cleft
