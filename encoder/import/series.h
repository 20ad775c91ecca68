// A time series of another program: one mesh, and fields of its points frame by frame, checked.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "encoder/import/components.h"
#include "encoder/import/frame_files.h"

namespace cleft {

/// A field and its name in the snapshot.
struct SeriesField {
  std::string source, name;            ///< in the files, in the snapshot
  std::string unit = {};               ///< "" where it is not told
  std::vector<Component> arrays = {};  ///< that hold its components
  int components = 1;                  ///< 1, 3 (a vector) or 6 (a symmetric tensor: XX YY ZZ XY YZ XZ)
  bool single = false;                 ///< stored in single precision
  bool of_cells = false;               ///< values of cells; a node gets the mean of its cells
  bool of_means = false;               ///< of such means, which part nowhere exactly
  bool all_nine = false;               ///< stored as the nine components of a tensor, row by row
};

/// At every node the mean over its cells; 0 where it has none.
std::vector<double> mean_of_cells(const SourceMesh& mesh, const std::vector<double>& values,
                                  std::size_t components);

/// "stress", "U:displacement" or "S:stress[MPa]": SourceName. Throws InputError if a name is invalid or
/// repeated.
std::vector<SeriesField> parse_fields(const std::vector<std::string>& texts);

/// Values of each field in a frame: N times its components, point by point.
using FieldValues = std::vector<std::vector<double>>;

class ImportedSeries {
 public:
  /// One file that open_series reads, or several of one mesh. Throws InputError if it has fewer than 2
  /// frames, times that do not increase, no such fields, or fields of other than 1, 2, 3, 6 or 9 components.
  ImportedSeries(const std::vector<std::string>& paths, const std::vector<SeriesField>& fields);
  ImportedSeries(const std::string& path, const std::vector<SeriesField>& fields)
      : ImportedSeries(std::vector<std::string>{path}, fields) {}
  virtual ~ImportedSeries() = default;

  const std::string& path() const { return path_; }
  std::vector<std::string> files() const { return files_->files(); }
  const std::vector<double>& times() const { return files_->times(); }
  std::size_t frames() const { return times().size(); }
  const std::vector<SeriesField>& fields() const { return fields_; }
  /// The mesh of the first frame, or the last where that is another (remeshed_files.h), without the nodes
  /// that no cell has, unless there are no cells.
  const SourceMesh& mesh() const { return mesh_; }

  /// Cells may be in another order. Throws FileError if the frame has other nodes or cells than the first,
  /// lacks a field, or holds a value that is not finite, or a tensor that is not symmetric: with the file,
  /// frame, node and field.
  FieldValues frame(std::size_t frame) const;
  using UseFrame = std::function<void(std::size_t frame, FieldValues& values)>;
  /// Calls `use` with each frame, in their order.
  virtual void for_each_frame(const UseFrame& use) const;
  /// The largest distance of a node from its place in the first frame, over the frames read so far.
  double farthest_moved() const { return farthest_moved_; }

  bool in_pieces() const { return files_->in_pieces(); }  ///< see FrameFiles
  /// What was done to bring frames to one mesh, for people.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Nodes that were left out because no cell has them.
  std::size_t loose_nodes() const { return loose_; }

  /// Merges nodes with equal `number`, which get the values of the first of them; the numbers are consecutive
  /// from 0.
  virtual void weld(const std::vector<std::int32_t>& number);

 protected:
  mutable double farthest_moved_ = 0;

 private:
  std::string where(std::size_t frame) const;
  void find_fields();
  WantedArrays sources_there(std::size_t frame) const;
  void compose_fields(SourceFrame& frame) const;
  SourceArray& array_of(SourceFrame& frame, std::size_t field) const;
  void describe_fields(SourceFrame& first);
  void leave_loose_nodes();
  CellOrder check_mesh(std::size_t frame, const SourceMesh& mesh) const;
  void check_values(std::size_t frame, SourceFrame& values) const;
  std::vector<double> at_nodes(std::size_t frame, std::size_t field, std::vector<double> values) const;

  std::string path_;
  std::unique_ptr<FrameFiles> files_;
  std::vector<SeriesField> fields_;
  SourceMesh mesh_as_read_, mesh_;
  std::vector<std::int32_t> kept_;  ///< nodes as read, one for each node; empty: all
  std::size_t loose_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace cleft
