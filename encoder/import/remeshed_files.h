// Series whose mesh changes, on one mesh.
#pragma once

#include <optional>

#include "encoder/import/frame_files.h"

namespace cleft {

/// Whether the last frame has another mesh than the first, `first`.
bool is_remeshed(const FrameFiles& files, const SourceMesh& first);

/// A series whose frames have the mesh of the last one, in which the break is longest. Values of other meshes
/// are interpolated in their own cells, on the side of the break on which a node's cells are. Where values in
/// between are lost by more than 0.1 % of the largest, as at a front that was there in an earlier frame, the
/// nodes of the earlier mesh are added: as cells with one corner or, on the break, one on either lip, each
/// with a line to a node of its side. Values of cells become those of nodes, each the mean of its cells,
/// first.
class RemeshedFiles : public FrameFiles {
 public:
  /// `wanted` of all frames. Throws InputError if a frame has another body.
  RemeshedFiles(std::unique_ptr<FrameFiles> files, const WantedArrays& wanted);

  std::vector<std::string> files() const override { return files_->files(); }
  const std::vector<double>& times() const override { return files_->times(); }
  bool in_pieces() const override { return false; }
  const std::string& file(std::size_t frame) const override { return files_->file(frame); }
  std::vector<std::string> point_arrays(std::size_t frame) const override;
  std::vector<std::string> cell_arrays(std::size_t) const override { return {}; }
  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override;

  /// What was done, with the largest loss at a node that was not added, over the largest value.
  std::string note() const;

 private:
  bool has_own_mesh(const SourceMesh& mesh) const;
  void add(const Vec3& place, const Vec3& inside, std::optional<std::int64_t> behind);

  std::unique_ptr<FrameFiles> files_;
  SourceMesh mesh_;           // of the last frame, then the nodes that were added
  std::vector<Vec3> inside_;  // of each node a place inside its cells
  std::size_t own_ = 0;       // nodes of the last frame
  std::size_t remeshed_ = 0;  // frames with another mesh
  double most_lost_ = 0;
};

}  // namespace cleft
