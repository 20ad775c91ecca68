// Snapshots as time series for ParaView and VTK: NAME.pvd, and a .vtu file for each frame in NAME/.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct ExportFigures {
  std::size_t files = 0, frames = 0;
  std::uintmax_t bytes = 0;

  ExportFigures& operator+=(const ExportFigures& other);
};

/// Of an array of this name; "" where it is not known. VTK's files hold it as UNITS_LABEL.
using Units = std::function<std::string(const std::string& name)>;

/// Writes folder/NAME.pvd and folder/NAME/frame_0000.vtu, ... In each: the points at their stress-free
/// positions, the displacement and all further arrays of the points in this frame, on cells `part` (0 skin, 1
/// tissue), and t as TimeValue. `progress` is called with the frame. Throws FileError if the snapshot is
/// damaged, std::runtime_error if the disk is full. Files written before an exception remain: `folder` is a
/// temporary one.
ExportFigures write_paraview_series(const SnapshotReader& reader, const std::string& folder,
                                    const std::string& name, const Units& units = {},
                                    const std::function<void(std::size_t)>& progress = {});

/// A moving surface without a snapshot: T triangles of N points at rest.
struct SurfaceSeries {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> parts;                                   ///< T: 0 skin, 1 left wall, 2 right wall
  std::vector<double> times;                                ///< F
  std::function<std::vector<Vec3>(double t)> displacement;  ///< N, from the points at rest
  Units units = {};
};

/// The same files for a surface, with the displacement only.
ExportFigures write_paraview_series(const SurfaceSeries& series, const std::string& folder,
                                    const std::string& name);

/// Values on the mesh of a snapshot at any times, without its own frames.
struct MeshSeries {
  const Snapshot* mesh = nullptr;
  std::vector<double> times;                                ///< F
  std::function<std::vector<Vec3>(double t)> displacement;  ///< N
  std::vector<SnapshotArray> arrays;
  std::function<std::vector<double>(std::size_t array, double t)> values;  ///< N times its components
  Units units = {};
};

/// The same files, with all arrays.
ExportFigures write_paraview_series(const MeshSeries& series, const std::string& folder,
                                    const std::string& name,
                                    const std::function<void(std::size_t)>& progress = {});

/// Throws InputError if folder/NAME.pvd or folder/NAME exists and was not written by write_paraview_series.
void refuse_to_replace_series(const std::string& folder, const std::string& name);

/// The same for a folder that must contain series only.
void refuse_to_replace_folder_of_series(const std::string& folder);

}  // namespace cleft
