// The walls of the wound: sheets of two layers between columns of vertices that hang from the path. Paper,
// section 3.4. A segment of the cut is a sheet between two columns, which is closed at first: its left and
// right layer are joined along all edges. Sewing it into the surface along an edge re-pairs the four
// triangles there: where (a, b) and (left, right) were neighbours, then (a, left) and (b, right) are. Thus a
// cut opens along the skin, along the column where its last segment ended, and along the wall of another cut
// that it meets; only the two pairs change. Afterwards each vertex is divided into as many copies as there
// are fans around it.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// Vertices from the skin down to the bottom: closed ones, or those on one side of an existing wound.
struct Column {
  std::vector<int> vertex;
  std::vector<double> depth_fraction;  ///< 0 at the skin, 1 at the bottom
  double s = 0;                        ///< along the path
  /// Whether its part above the bottom will be divided when the segment is sewn in: at the mesh's boundary,
  /// at a wound as deep as the cut, and where another segment ends.
  bool opens = false;
  std::size_t first_new = 1;  ///< first vertex of its own; those above belong to a wound
  std::size_t size() const { return vertex.size(); }
};

/// A new column below `top` with `rows` edges along `down`, whose length is the depth.
Column hang_column(CutMesh& mesh, int top, const Vec3& down, double s, int cut, int rows);

/// The column below a vertex of a wound, down to the wound's bottom but not below `depth` (a vertex is made
/// there). Vertices that the wound's wall lacks below `top` are made. A column longer than the depth of the
/// wound continues straight along `down`, whose length is `depth`, through `below` if given (the continuation
/// on the other side of the wound), else through new vertices.
Column wound_column(CutMesh& mesh, int top, const Vec3& down, double s, int cut, int rows,
                    const std::vector<int>& below);

/// Whether a sheet is possible between two columns: one of them must open completely, so that no edge joins
/// two closed vertices and belongs to both layers.
inline bool can_stand(const Column& p, const Column& q) { return p.opens || q.opens; }

/// The sheets of one cut, sewn in segment by segment.
class Sewing {
 public:
  Sewing(CutMesh& mesh, int cut) : mesh_(mesh), cut_(cut) {}

  /// A sheet from column p to column q, sewn to the skin along the edge between their tops, and to the wound
  /// along p, if any. Throws InputError if there is not skin on both sides of the edge.
  void add(const Column& p, const Column& q);
  /// Sews the last sheet to the wound along its column q.
  void join_end();
  /// Leaves the sheet open at column q (or with `at_start`, p), which is on the mesh's boundary.
  void open_at_boundary(bool at_start);

  /// Divides the vertices of the columns touched since the last call into one copy for each fan.
  void part_vertices();

  /// The lips' vertices at either end of a sheet, which is given by its first triangle.
  struct Lips {
    int left, right;
  };
  Lips lips_at_start(int sheet) const;
  Lips lips_at_end(int sheet) const;
  int last_sheet() const { return first_; }

 private:
  void sew(int v, int w, int sheet_triangle);
  void sew_column(const std::vector<int>& column, const std::vector<int>& left_edges);
  void part(int v);
  void describe(int v, const std::vector<int>& fan);

  CutMesh& mesh_;
  int cut_;
  Column p_, q_;
  std::vector<int> along_p_, along_q_;  // left triangles on the edges of either column
  int first_ = -1;                      // the last sheet's first triangle, left below the skin
  std::vector<int> touched_vertices_;
  std::vector<int> seeds_;  // triangles on edges that were sewn, left ones first
};

}  // namespace cleft
