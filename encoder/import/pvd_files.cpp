#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

/// Contiguous values of the type of `To`, whatever VTK keeps.
template <class To, class T>
std::vector<T> values_of(vtkDataArray* array) {
  vtkNew<To> copy;
  copy->DeepCopy(array);
  return {copy->GetPointer(0), copy->GetPointer(0) + copy->GetNumberOfValues()};
}

/// The cells of a surface, one by one: VTK keeps them by kind.
void add_cells(SourceMesh& mesh, vtkPolyData* surface) {
  mesh.cell_offsets = {0};
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c) {
    surface->GetCellPoints(c, corners);
    mesh.cell_types.push_back(static_cast<std::uint8_t>(surface->GetCellType(c)));
    mesh.connectivity.insert(mesh.connectivity.end(), corners->begin(), corners->end());
    mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
  }
}

SourceMesh mesh_of(vtkPointSet* points) {
  SourceMesh mesh;
  const std::vector<double> numbers = values_of<vtkDoubleArray, double>(points->GetPoints()->GetData());
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  auto* grid = vtkUnstructuredGrid::SafeDownCast(points);
  if (!grid) {
    add_cells(mesh, vtkPolyData::SafeDownCast(points));
    return mesh;
  }
  if (grid->GetNumberOfCells() == 0) {
    mesh.cell_offsets = {0};
    return mesh;
  }
  mesh.cell_types = values_of<vtkUnsignedCharArray, std::uint8_t>(grid->GetCellTypesArray());
  mesh.cell_offsets = values_of<vtkTypeInt64Array, std::int64_t>(grid->GetCells()->GetOffsetsArray());
  mesh.connectivity = values_of<vtkTypeInt64Array, std::int64_t>(grid->GetCells()->GetConnectivityArray());
  return mesh;
}

std::vector<std::string> names_of(vtkDataArraySelection* selection) {
  std::vector<std::string> names;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i) names.emplace_back(selection->GetArrayName(i));
  return names;
}

/// A file of pieces, each with its own nodes where they meet.
constexpr const char* of_pieces = ".pvtu";

vtkSmartPointer<vtkXMLReader> reader_of(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == of_pieces) return vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
  if (ending == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
}

/// One .vtu, .pvtu or .vtp file, open.
class VtuFile {
 public:
  explicit VtuFile(const std::string& path) : path_(path), reader_(reader_of(path)), reading_(reader_.Get()) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
    reader_->SetFileName(path.c_str());
    reader_->UpdateInformation();
    refuse_errors();
  }

  std::vector<std::string> point_arrays() { return names_of(reader_->GetPointDataArraySelection()); }
  std::vector<std::string> cell_arrays() { return names_of(reader_->GetCellDataArraySelection()); }

  SourceFrame read(const std::vector<std::string>& arrays) {
    reader_->GetCellDataArraySelection()->DisableAllArrays();
    reader_->GetPointDataArraySelection()->DisableAllArrays();
    for (const std::string& name : arrays) reader_->GetPointDataArraySelection()->EnableArray(name.c_str());
    reader_->Update();
    refuse_errors();
    auto* grid = vtkPointSet::SafeDownCast(reader_->GetOutputDataObject(0));
    if (auto* cells = vtkUnstructuredGrid::SafeDownCast(grid)) cells->RemoveGhostCells();
    if (!grid || !grid->GetPoints() || grid->GetNumberOfPoints() == 0)
      throw FileError(path_, "holds no points");
    SourceFrame frame{mesh_of(grid), {}};
    for (const std::string& name : arrays) frame.arrays.push_back(array_of(grid, name));
    return frame;
  }

 private:
  void refuse_errors() const {
    if (reading_.failed())
      throw FileError(path_, "cannot be read as an unstructured grid: " + reading_.reason());
  }

  SourceArray array_of(vtkPointSet* grid, const std::string& name) const {
    vtkDataArray* array = grid->GetPointData()->GetArray(name.c_str());
    if (!array) throw FileError(path_, "the array '" + name + "' of the points holds no numbers");
    return {array->GetNumberOfComponents(), array->GetDataType() == VTK_FLOAT,
            values_of<vtkDoubleArray, double>(array)};
  }

  std::string path_;
  vtkSmartPointer<vtkXMLReader> reader_;
  VtkListener reading_;
};

class PvdFiles : public FrameFiles {
 public:
  explicit PvdFiles(const std::string& path) : path_(path) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!list) throw FileError(path, "is no .pvd file, which has a <Collection> of files, or is damaged");
    for (int i = 0; i < list->GetNumberOfNestedElements(); ++i)
      if (list->GetNestedElement(i)->GetName() == std::string("DataSet")) add(list->GetNestedElement(i));
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> all = frames_;
    all.push_back(path_);
    return all;
  }
  const std::vector<double>& times() const override { return times_; }
  bool in_pieces() const override { return in_pieces_; }
  const std::string& file(std::size_t frame) const override { return frames_[frame]; }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    return VtuFile(frames_[frame]).point_arrays();
  }
  std::vector<std::string> cell_arrays(std::size_t frame) const override {
    return VtuFile(frames_[frame]).cell_arrays();
  }
  SourceFrame read(std::size_t frame, const std::vector<std::string>& arrays) const override {
    return VtuFile(frames_[frame]).read(arrays);
  }

 private:
  void add(vtkXMLDataElement* entry) {
    const std::string where = path_ + ": entry " + std::to_string(frames_.size() + 1);
    const char *name = entry->GetAttribute("file"), *time = entry->GetAttribute("timestep");
    if (!name || !time) throw InputError(where + " lacks " + (name ? "timestep" : "file"));
    const std::string file = (fs::path(path_).parent_path() / name).string();
    const std::string ending = fs::path(file).extension().string();
    if (ending != ".vtu" && ending != of_pieces && ending != ".vtp")
      throw InputError(
          where + ": '" + name +
          "' is no .vtu file, nor a .pvtu or .vtp; write unstructured grids or surfaces, each whole "
          "in a file (in ParaView: Merge Blocks, then Save Data as .pvd)");
    in_pieces_ = in_pieces_ || ending == of_pieces;
    if (!fs::is_regular_file(file)) throw InputError(where + ": there is no file '" + file + "'");
    frames_.push_back(file);
    times_.push_back(parse_number(time, where + ", timestep"));
  }

  std::string path_;
  std::vector<std::string> frames_;
  std::vector<double> times_;
  bool in_pieces_ = false;
};

}  // namespace

SourceMesh read_vtu_mesh(const std::string& path) { return VtuFile(path).read({}).mesh; }

std::unique_ptr<FrameFiles> open_pvd(const std::string& path) { return std::make_unique<PvdFiles>(path); }

}  // namespace cleft
