// The files of a series of any format: their content frame by frame, unchecked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "encoder/import/source_mesh.h"

namespace cleft {

/// An array of the points, converted to double precision.
struct SourceArray {
  int components = 1;
  bool single = false;  ///< stored in single precision
  std::vector<double> values;
};

struct SourceFrame {
  SourceMesh mesh;
  std::vector<SourceArray> arrays;  ///< those requested
};

class FrameFiles {
 public:
  virtual ~FrameFiles() = default;
  /// All files of the series.
  virtual std::vector<std::string> files() const = 0;
  virtual const std::vector<double>& times() const = 0;
  /// Whether nodes where pieces of the mesh meet are there once for each piece.
  virtual bool in_pieces() const { return false; }
  /// The file that holds a frame.
  virtual const std::string& file(std::size_t frame) const = 0;
  virtual std::vector<std::string> point_arrays(std::size_t frame) const = 0;
  virtual std::vector<std::string> cell_arrays(std::size_t frame) const = 0;
  /// Throws FileError if the file is damaged. `arrays` are names of point_arrays().
  virtual SourceFrame read(std::size_t frame, const std::vector<std::string>& arrays) const = 0;
};

/// A .pvd that lists .vtu, .pvtu or .vtp files, by VTK's readers. Throws FileError if it lists no readable
/// file, or no times.
std::unique_ptr<FrameFiles> open_pvd(const std::string& path);

/// The points and cells of a .vtu file.
SourceMesh read_vtu_mesh(const std::string& path);

/// A series by the ending of its name. Throws InputError for one that is not read, with what to do.
std::unique_ptr<FrameFiles> open_series(const std::string& path);

/// A temporal .vtkhdf with one mesh for each step, through base/h5: VTK 9.1 reads no times in them.
std::unique_ptr<FrameFiles> open_vtkhdf(const std::string& path);

}  // namespace cleft
