// A cut that grows through a surface mesh as the blade advances. Paper, section 3.4.
//
//   Incision incision(mesh, path, {});
//   incision.advance_to(path.length());
//
// The blade's path splits one triangle after another; behind the tip every vertex of the path is doubled into
// two lips, from which walls reach down along -N(s). Start and tip stay closed, so that the mesh stays
// watertight where it was. Where the path crosses the mesh's boundary the cut is open. Where it meets a wound
// (of an earlier cut in the same mesh, or its own) it ends in its wall, and goes on from the opposite lip.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surroundings.h"
#include "explorer/incision/walls.h"

namespace cleft {

/// Lengths in the mesh's units.
struct IncisionOptions {
  std::optional<double> max_edge;  ///< of triangles near the path; default length / 30; 0: leave them
  std::optional<double>
      chord_tolerance;  ///< how far a straight piece may stray from C(s); default length / 1000
  double snap =
      IncisionTolerances::snap;  ///< a vertex nearer to the path than this part of its room is moved onto it
  /// How far over the skin beside the path, and beyond its ends, a field may move vertices: the less, the
  /// sooner the cut begins. 0: nothing will be moved.
  double reach = std::numeric_limits<double>::infinity();
  double refined = std::numeric_limits<double>::infinity();  ///< how much of the path, from its start
};

class Incision {
 public:
  /// Finds the start, and refines the mesh near the path where asked. Throws InputError where the path has no
  /// depth or does not meet the mesh. The first form cuts a mesh of its own, the second one that may have
  /// been cut before; it must outlive the incision, and only the last of several may advance, or be undone.
  Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options = {});
  Incision(CutMesh& mesh, ScalpelPath path, const IncisionOptions& options = {});

  /// Cuts on to arc length s, clamped to the path; backwards is no step at all. Cutting to s in one step or
  /// in many gives the same mesh. Throws InputError where the path cannot go on (a place that is not a
  /// manifold, a surface that turns away from N) and leaves the mesh as cut until there.
  void advance_to(double s);

  /// For a blade whose way is found as it goes. The path leads to `next` from where it led to before, and
  /// straight on; triangles there become small, what lies beside it is found again as far as `ahead` beyond,
  /// and the blade cuts on to `next`. Errors as advance_to; where the direction is none the path stays.
  void lead_on(const ScalpelPath::Point& next, double ahead);
  /// Where the path leads by now, beyond which it goes straight on.
  double led() const { return led_; }

  /// Takes the whole cut back, refinement included, and makes it again: both bit for bit.
  void undo();
  void redo();
  bool undone() const { return undone_.has_value(); }

  const CutMesh& mesh() const { return mesh_; }
  const ScalpelPath& path() const { return path_; }
  const Surroundings& surroundings() const { return surroundings_; }  ///< of the skin before the cut
  int cut() const { return cut_; }                                    ///< the number of this cut in its mesh
  double tip() const { return chain_.back().s; }                      ///< arc length of the tip's vertex
  double start() const { return chain_.front().s; }
  /// Whether the path has left the mesh over its boundary.
  bool left_mesh() const { return state_.left_mesh; }
  int original_triangles() const { return original_triangles_; }
  int moved_vertices() const;
  /// Whether slivers were mended across a bend, which moves the surface by up to chord_tolerance / 10.
  bool bent() const { return bent_; }

  /// The triangles that the last advance_to, undo or redo has changed, added or taken away (the latter are
  /// out of range), in no order: what a structure over the mesh's triangles has to take in again.
  const std::vector<int>& changed_triangles() const { return mesh_.changed(); }

  /// The path's vertices from start to tip: left and right are the same where the cut is closed. Where the
  /// path crosses a wound there are two of the same s, one on either lip.
  struct ChainVertex {
    int left, right;
    double s;
  };
  const std::vector<ChainVertex>& chain() const { return chain_; }

  /// How far the straight pieces between the chain's vertices stray from the blade, at most.
  double chord_error() const;

 private:
  Incision(std::unique_ptr<CutMesh> own, CutMesh* mesh, ScalpelPath path, const IncisionOptions& options);

  /// How the path goes on from the last vertex of the chain.
  struct Step {
    enum Kind { vertex, edge, face } kind;
    int triangle;  ///< edge, face
    int index;     ///< the vertex, or the number of the edge
    Vec3 place;
    double s;
    bool inside = false;  ///< not where the path crosses an edge, but between two such places
  };

  // Where its vertices come to stand: incision_places.cpp.
  Step find_start() const;
  std::optional<Step> start_on_face(double reach) const;
  std::optional<Step> start_on_boundary(double reach) const;
  std::optional<Step> snapped(const Step& crossing, double to) const;
  std::vector<int> triangles_at(const Step& start) const;
  Step placed(int triangle, const Vec3& place, double s) const;
  double beside(const Vec3& place, double s) const;
  bool drawn_along_edge(int v, double s) const;
  bool may_move(int v, const Vec3& place) const;
  bool may_reach(int v) const;
  bool begins_ahead(const Vec3& start, const Vec3& drawn_to) const;
  bool keeps_fold(int v, const Vec3& place, int triangle) const;
  double room_of(int v) const;
  std::optional<Step> exit_at(int v, double s) const;

  // Where the path goes on: incision_walk.cpp.
  const Step& next_step();
  /// Where the blade's line is after a while: in a triangle of the tip's fan, or crossing its edge.
  struct Track {
    int triangle = -1;  ///< -1: the line does not go on over the surface
    int edge = -1;      ///< -1: it has reached the s asked for
    double s = 0;
  };
  Track entered(const std::vector<int>& fan, double size, double limit) const;
  Track follow(int vertex, double s) const;
  int triangle_ahead() const;
  Step crossing(const Track& track) const;
  Step shorter(const Step& step, double to) const;
  Step step_at(const Track& track) const;
  bool too_soon_at_wound(const Step& step) const;
  double chord_error(const Vec3& from, const Vec3& to, double s_from, double s_to) const;
  bool wounds_cross_at(int v) const;
  bool go_on_from_wound();
  [[noreturn]] void report_end() const;
  double wall_spacing(int start, double max_edge) const;
  int tip_vertex() const { return state_.from >= 0 ? state_.from : chain_.back().left; }

  // How far to cut: incision.cpp.
  void rehearse();
  void cut_on_to(double s);
  void step_on();
  void check_progress() const;

  // What a step changes in the mesh: incision_change.cpp.
  void take(const Step& step);
  int realise(const Step& step);
  bool made_room(const Step& step);
  void grow(int next, double s);
  void mend(const CutMesh::Checkpoint& since);
  std::array<int, 2> pending_edge() const;
  Column start_column();
  Vec3 down(double s) const { return -path_.depth(s) * path_.at(s).outward; }

  std::unique_ptr<CutMesh> own_;
  CutMesh& mesh_;
  ScalpelPath path_;
  IncisionOptions options_;
  CutMesh::Checkpoint before_cut_;
  int cut_;
  double chord_tolerance_, longest_step_, max_edge_;
  double led_ = 0;
  int original_triangles_;
  double worst_before_;  // radius ratio
  double asked_;         // radius ratio of triangles that the cut makes, at least
  int rows_ = 3;
  bool bent_ = false;
  std::vector<ChainVertex> chain_;
  Surroundings surroundings_;

  enum class End { closed, boundary, wound };
  struct State {
    End start = End::closed;       // of the piece between two wounds that the tip is in
    std::size_t piece = 0;         // its first vertex in the chain
    bool pending = false;          // its first segment is not sewn in yet: both ends are closed
    bool arrived = false;          // the tip's vertex is on a wound
    int from = -1;                 // where the path goes on from that wound
    std::optional<Column> column;  // below the tip
    std::vector<int> below;        // below the wound where the path came to it
    // Triangles that were left worse than asked, and how often they were tried: a step beside them may make
    // it possible to mend them.
    std::vector<std::pair<int, int>> poor;
    bool left_mesh = false;
  };
  State state_;

  // The vertex at the tip is provisional: it is taken back before the blade goes on, so that where the blade
  // stopped on its way leaves no trace.
  struct Before {
    CutMesh::Checkpoint mesh;
    std::size_t chain;
    std::vector<ChainVertex> last;
    State state;
  };
  Before before() const;
  void roll_back(const Before& before);
  std::optional<Before> provisional_;
  std::optional<Step> next_;
  std::optional<CutMesh::Undone> undone_;
};

}  // namespace cleft
