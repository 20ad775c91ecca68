// A cut that grows through a surface mesh as the blade advances. Paper, section 3.4.
//
//   Incision incision(mesh, path, {});
//   incision.advance_to(path.length());
//
// The blade's path splits one triangle after another; behind the tip every vertex of the path is doubled into
// two lips, from which walls reach down along -N(s). Start and tip stay closed, so that the mesh stays
// watertight where it was. Where the path crosses the mesh's boundary the cut is open.
#pragma once

#include <optional>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/walls.h"

namespace cleft {

/// Lengths in the mesh's units.
struct IncisionOptions {
  std::optional<double> max_edge;  ///< of triangles near the path; default length / 30; 0: leave them
  std::optional<double>
      chord_tolerance;  ///< how far a straight piece may stray from C(s); default length / 1000
  double snap = 0.2;    ///< a vertex nearer to the path than this part of its room is moved onto it
};

class Incision {
 public:
  /// Finds the start, and refines the mesh near the path where asked. Throws InputError where the path has no
  /// depth or does not meet the mesh.
  Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options = {});

  /// Cuts on to arc length s, clamped to the path; backwards is no step at all. Cutting to s in one step or
  /// in many gives the same mesh. Throws InputError where the path cannot go on (a place that is not a
  /// manifold, a surface that turns away from N, its own cut) and leaves the mesh as cut until there.
  void advance_to(double s);

  const CutMesh& mesh() const { return mesh_; }
  const ScalpelPath& path() const { return path_; }
  double tip() const { return chain_.back().s; }  ///< arc length of the tip's vertex
  double start() const { return chain_.front().s; }
  /// Whether the path has left the mesh over its boundary.
  bool left_mesh() const { return left_mesh_; }
  int original_triangles() const { return original_triangles_; }
  int moved_vertices() const;

  /// The path's vertices from start to tip: left and right are the same where the cut is closed.
  struct ChainVertex {
    int left, right;
    double s;
  };
  const std::vector<ChainVertex>& chain() const { return chain_; }

 private:
  /// How the path goes on from the last vertex of the chain.
  struct Step {
    enum Kind { vertex, edge, face } kind;
    int triangle;  ///< edge, face
    int index;     ///< the vertex, or the number of the edge
    Vec3 place;
    double s;
  };

  Step find_start() const;
  std::optional<Step> start_on_face(double reach) const;
  std::optional<Step> start_on_boundary(double reach) const;

  // Where the path goes on: incision_walk.cpp.
  const Step& next_step();
  std::optional<Step> exit_of_fan(int pieces, bool snap) const;
  std::optional<Step> snapped(const Step& crossing) const;
  std::optional<Step> inside_fan(int v, double s) const;
  Step on_chord(const Step& next, double s) const;
  Step placed(int triangle, const Vec3& place, double s) const;
  bool may_move(int v, const Vec3& place) const;
  double chord_error(const Vec3& to) const;
  PathCoordinates beside(const Vec3& x) const;
  double wall_spacing(int start, double max_edge) const;
  int tip_vertex() const { return chain_.back().left; }

  // Changing the mesh: incision.cpp.
  void take(const Step& step);
  int realise(const Step& step);
  void grow(int next, double s);
  int part(int v, int first_right, int last_right, int left);
  Vec3 down(double s) const { return -path_.depth(s) * path_.at(s).outward; }

  CutMesh mesh_;
  ScalpelPath path_;
  IncisionOptions options_;
  double chord_tolerance_, longest_step_;
  int original_triangles_;
  std::vector<ChainVertex> chain_;
  Walls walls_{3};
  bool open_start_ = false, left_mesh_ = false;

  // The vertex at the tip is provisional: it is taken back before the blade goes on, so that where the blade
  // stopped on its way leaves no trace.
  struct Before {
    std::size_t chain;
    ChainVertex last;
    Walls::Mark walls;
    bool left_mesh;
  };
  Before before() const;
  void roll_back(const Before& before);
  std::optional<Before> provisional_;
  std::optional<Step> next_;
};

}  // namespace cleft
