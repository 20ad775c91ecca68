// Data of VTK's readers as frames. For .cpp files that include VTK.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "encoder/import/frame_files.h"

class vtkDataObject;
class vtkUnstructuredGrid;

namespace cleft {

/// Names of the arrays of points, and of cells, that every block with cells has.
std::vector<std::string> point_array_names(vtkDataObject* data);
std::vector<std::string> cell_array_names(vtkDataObject* data);

/// The grids and surfaces of all blocks, one after another, with the wanted arrays. Throws FileError about
/// `path` where there are no points, or a block lacks an array.
SourceFrame frame_of(vtkDataObject* data, const WantedArrays& wanted, const std::string& path);

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const SourceMesh& mesh);

/// Whether it has more than one block with points: each then has its own nodes where blocks meet.
bool has_pieces(vtkDataObject* data);

}  // namespace cleft
