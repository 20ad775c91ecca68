// Cuts along given paths, made in one mesh one after the other.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"

namespace cleft {

/// Lengths in mm.
struct MeshCutsOptions {
  double scale = 1;                ///< mm per mesh unit
  std::optional<double> progress;  ///< how far the blade of the last cut has come; none: the whole path
  std::optional<double> max_edge;  ///< see IncisionOptions
};

// Of every vertex of a mesh with cuts.
std::vector<double> depths_of(const CutMesh& mesh, double scale);  ///< mm below the skin
std::vector<double> regions_of(const CutMesh& mesh);  ///< 0 skin and lips, 1 left wall, 2 right wall
std::vector<double> depth_fractions_of(const CutMesh& mesh);

class MeshCuts {
 public:
  /// At least one path, with depths, in mesh units. `origin`: the mesh is cut in coordinates from there
  /// (local_origin). `field`, if given, is the one that will open the cuts: what it does not reach is not
  /// prepared. Throws InputError as Incision does, and for a max_edge that is too small.
  MeshCuts(const SurfaceMesh& surface, const Vec3& origin, const std::vector<ScalpelPath>& paths,
           const Field* field, const MeshCutsOptions& options);
  MeshCuts(const MeshCuts&) = delete;
  MeshCuts& operator=(const MeshCuts&) = delete;

  double scale() const { return scale_; }  ///< mm per mesh unit
  const Vec3& origin() const { return origin_; }
  const SurfaceMesh& uncut() const { return uncut_; }  ///< from the origin
  const CutMesh& mesh() const { return mesh_; }        ///< from the origin
  const std::vector<const Incision*>& cuts() const { return list_; }
  double progress() const { return progress_; }          ///< where the blade is, mm of all paths
  double seconds() const { return seconds_; }            ///< that making the cuts took
  double stepping_seconds() const { return stepping_; }  ///< of these, for the steps of the blade

  // Of every vertex of mesh().
  std::vector<double> depths() const { return depths_of(mesh_, scale_); }
  std::vector<double> regions() const { return regions_of(mesh_); }
  /// The mesh's own, and those of tissue below the skin; empty where it has none.
  std::vector<PointColor> colors() const;
  std::vector<double> along() const;  ///< mm along the path; of a vertex on no cut, along the last one

 private:
  void make(ScalpelPath path, const IncisionOptions& options, double progress);

  double scale_;
  Vec3 origin_;
  SurfaceMesh uncut_;
  CutMesh mesh_;
  std::vector<std::unique_ptr<Incision>> made_;
  std::vector<const Incision*> list_;
  double progress_ = 0, seconds_ = 0, stepping_ = 0;
};

}  // namespace cleft
