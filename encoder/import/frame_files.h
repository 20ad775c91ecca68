// The files of a series of any format: their content frame by frame, unchecked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "encoder/import/source_mesh.h"

namespace cleft {

/// Names of arrays.
struct WantedArrays {
  std::vector<std::string> points, cells;
};

/// An array of the points or of the cells, converted to double precision.
struct SourceArray {
  int components = 1;
  bool single = false;  ///< stored in single precision
  std::vector<double> values;
};

struct SourceFrame {
  SourceMesh mesh;
  std::vector<SourceArray> arrays, cell_arrays;  ///< those requested
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
  /// Throws FileError if the file is damaged. `wanted` are names of point_arrays() and cell_arrays().
  virtual SourceFrame read(std::size_t frame, const WantedArrays& wanted) const = 0;
};

/// Throws InputError about `where` if a mesh is damaged, has no cells, or cells that snapshots cannot hold.
void check_cells(const std::string& where, const SourceMesh& mesh);

/// Brings values of the cells into an order (order_as).
void order_cells(SourceFrame& frame, const CellOrder& order);

/// Appends another piece of the mesh, and the values there. Throws FileError about `path` if an array has
/// other components there.
void append(SourceFrame& all, const SourceFrame& piece, const std::string& path);

/// A series by the ending of its name, or one mesh with different arrays in several. Throws InputError for
/// one that is not read, with what to do.
std::unique_ptr<FrameFiles> open_series(const std::vector<std::string>& paths);

/// Arrays that several series of one mesh hold; one whose name is in several of them is called SERIES/NAME,
/// with the series' name without folders and ending. Throws InputError if times or meshes differ.
std::unique_ptr<FrameFiles> joined(std::vector<std::unique_ptr<FrameFiles>> series,
                                   const std::vector<std::string>& paths);

/// A .pvd that lists .vtu, .pvtu, .vtp, .vtm or .vtk files, by VTK's readers, or .frd files, of which the
/// last results are taken; entries of one time and different `part` are one frame. Throws FileError if it
/// lists no readable file, or no times.
std::unique_ptr<FrameFiles> open_pvd(const std::string& path);

/// A list of such files and their times in JSON, as ParaView and OpenFOAM write it: NAME.vtk.series.
std::unique_ptr<FrameFiles> open_listed(const std::string& path);

/// The points and cells of a .vtu file.
SourceMesh read_vtu_mesh(const std::string& path);

/// Files with all frames in them, by VTK's readers. Exodus: the other files of a mesh that was decomposed,
/// NAME.e.4.0, NAME.e.4.1, ..., are found.
std::unique_ptr<FrameFiles> open_exodus(const std::string& path);
std::unique_ptr<FrameFiles> open_ensight(const std::string& path);
std::unique_ptr<FrameFiles> open_cgns(const std::string& path);

/// CalculiX's results, in text or binary: nodes, elements, and results at nodes, one frame for each time.
std::unique_ptr<FrameFiles> open_frd(const std::string& path);

/// Temporal collections of grids in XML whose numbers are in the text or in HDF5 files.
std::unique_ptr<FrameFiles> open_xdmf(const std::string& path);

/// A temporal .vtkhdf, through base/h5: VTK 9.1 reads no times in them.
std::unique_ptr<FrameFiles> open_vtkhdf(const std::string& path);

}  // namespace cleft
