#include "encoder/import/decoded_vtu.h"

#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "encoder/import/vtk_frames.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const std::string& out) { return fs::path(out).replace_extension(""); }

/// The folder in which the list and the frames' folder appear; refused where they are there already.
std::string free_place(const std::string& out) {
  refuse_existing(fs::path(out).replace_extension(".pvd"));
  const fs::path folder = folder_of(out);
  refuse_existing(folder);
  return folder.has_parent_path() ? folder.parent_path().string() : ".";
}

std::string frame_name(std::size_t frame) {
  std::ostringstream name;
  name << "frame_" << std::setw(4) << std::setfill('0') << frame << ".vtu";
  return name.str();
}

void write_frame(vtkUnstructuredGrid* grid, const std::vector<DecodedValues>& all, const std::string& path) {
  for (const DecodedValues& values : all) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(values.name.c_str());
    array->SetNumberOfComponents(values.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.numbers.size()) / values.components);
    std::copy(values.numbers.begin(), values.numbers.end(), array->GetPointer(0));
    if (!values.unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), values.unit.c_str());
    grid->GetPointData()->AddArray(array);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetCompressionLevel(1);  // most of the time is the compressor's
  write_text_file(path, xml_of(writer.Get(), grid, path));
}

}  // namespace

DecodedVtu::DecodedVtu(const std::string& out)
    : name_(folder_of(out).filename().string()), place_(free_place(out), name_) {
  fs::create_directory(folder());
}

std::string DecodedVtu::folder() const { return (fs::path(place_.path()) / name_).string(); }

void DecodedVtu::commit(const std::vector<double>& times) {
  std::ostringstream list;
  list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t j = 0; j < times.size(); ++j)
    list << "<DataSet timestep=\"" << shortest(times[j]) << "\" part=\"0\" file=\""
         << (fs::path(name_) / frame_name(j)).string() << "\"/>\n";
  list << "</Collection>\n</VTKFile>\n";
  const std::string pvd = name_ + ".pvd";
  write_text_file((fs::path(place_.path()) / pvd).string(), list.str());
  place_.commit({name_, pvd});
}

void write_frames(const DecodedNodes& decoded, const SourceMesh& mesh, FramesInTurn turn,
                  const std::string& folder, const std::function<void(const std::string&)>& progress) {
  const std::size_t frames = times_of(*decoded.first).size();
  const auto grid = grid_of(mesh);
  for (std::size_t j = turn.first; j < frames; j += turn.step) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(frames));
    write_frame(grid, values_at(decoded, j), (fs::path(folder) / frame_name(j)).string());
  }
}

}  // namespace cleft
