// A cut that grows through a surface mesh as the blade advances. Paper, section 3.4.
//
//   Incision incision(mesh, path, {});
//   incision.advance_to(path.length());
//
// The blade's path splits one triangle after another; behind the tip every vertex of the path is doubled into
// two lips, from which walls reach down along -N(s). Start and tip remain closed, so that a watertight mesh
// remains watertight. Where the path crosses the mesh's boundary the cut is open. Where it meets a wound (of
// an earlier cut in the same mesh, or its own) it ends in its wall, and continues from the opposite lip.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surroundings.h"

namespace cleft {

/// Lengths in the mesh's units.
struct IncisionOptions {
  std::optional<double> max_edge;  ///< of triangles near the path; default length / 30; 0: leave them
  /// How far a straight piece may stray from C(s); default length / 1000.
  std::optional<double> chord_tolerance;
  /// A vertex nearer to the path than this part of its room is moved onto it.
  double snap = IncisionTolerances::snap;
  /// Distance over the skin, from the path and beyond its ends, in which a field may move vertices: a smaller
  /// one shortens the preparation. 0: no vertex will be moved.
  double reach = std::numeric_limits<double>::infinity();
  double refined =
      std::numeric_limits<double>::infinity();  ///< length of the path that is refined, from its start
};

struct IncisionState;

class Incision {
 public:
  /// Finds the start, and refines the mesh near the path on request. Throws InputError if the path has no
  /// depth or does not meet the mesh. The first form cuts a mesh of its own, the second one that may have
  /// been cut before; it must outlive the incision, and only the last of several may advance, or be undone.
  Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options = {});
  Incision(CutMesh& mesh, ScalpelPath path, const IncisionOptions& options = {});
  Incision(Incision&&) noexcept;
  ~Incision();

  /// Cuts to arc length s, clamped to the path; a smaller s has no effect. Cutting to s in one step or in
  /// many gives the same mesh. Throws InputError if the path cannot continue (a place that is not a manifold,
  /// a surface that turns away from N); the mesh then remains cut up to there.
  void advance_to(double s);

  /// For a path that is not known in advance: extends the path to `next` and straight beyond it, refines the
  /// triangles there, searches the surroundings again up to `ahead` beyond, and cuts to `next`. Errors as
  /// advance_to; if the direction is invalid the path is unchanged.
  void extend(const ScalpelPath::Point& next, double ahead);
  /// Arc length up to which the path was extended; beyond it the path is straight.
  double extended_to() const { return extended_to_; }
  /// Ends a path that was extended where the blade is: from then on it is one that was known in advance, and
  /// extended_to() is 0. Has no effect on others.
  void end_path();
  /// After end_path(): the surroundings of the whole path, which have been found piece by piece. Changes
  /// nothing else.
  void search_again();

  /// Undoes and redoes the whole cut, including refinement: both bit for bit.
  void undo();
  void redo();
  bool undone() const { return undone_.has_value(); }

  const CutMesh& mesh() const { return mesh_; }
  const ScalpelPath& path() const { return path_; }
  const Surroundings& surroundings() const { return surroundings_; }  ///< of the skin before the cut
  int cut() const { return cut_; }                                    ///< the number of this cut in its mesh
  double tip() const;                                                 ///< arc length of the tip's vertex
  double start() const;
  /// Whether the path has left the mesh over its boundary.
  bool left_mesh() const;
  /// Whether more of the path is left than a rest that is not worth a vertex, within the mesh.
  bool is_short_of_end() const;
  int original_triangles() const { return original_triangles_; }
  int moved_vertices() const;
  /// Whether slivers were repaired across a bend, which moves the surface by up to chord_tolerance / 10.
  bool bent() const;

  /// The triangles that the last advance_to, undo or redo has changed, added or removed (the latter are out
  /// of range), in no order: those that a structure over the mesh's triangles must update.
  const std::vector<int>& changed_triangles() const { return mesh_.changed(); }

  /// The path's vertices from start to tip: left and right are equal where the cut is closed. Where the path
  /// crosses a wound there are two with the same s, one on either lip.
  struct ChainVertex {
    int left, right;
    double s;
  };
  const std::vector<ChainVertex>& chain() const;

  /// The largest distance of the straight pieces between the chain's vertices from the blade.
  double chord_error() const;

 private:
  Incision(std::unique_ptr<CutMesh> own, CutMesh* mesh, ScalpelPath path, const IncisionOptions& options);
  void begin(const IncisionOptions& options);

  std::unique_ptr<CutMesh> own_;
  CutMesh& mesh_;
  CutMesh::Checkpoint before_cut_;
  int cut_;
  std::unique_ptr<IncisionState> state_;  // of the steps: incision_state.h
  ScalpelPath& path_;                     // the state's
  double max_edge_, reach_;
  double extended_to_ = 0;
  int original_triangles_;
  Surroundings surroundings_;
  std::optional<CutMesh::Undone> undone_;
};

}  // namespace cleft
