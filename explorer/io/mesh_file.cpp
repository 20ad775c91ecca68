#include "explorer/io/mesh_file.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkOBJWriter.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"

namespace cleft {

namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// VTK's filters trust the corners that a file names.
void check_corners(const std::string& path, vtkPolyData* data) {
  for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()}) {
    vtkIdType size;
    const vtkIdType* corners;
    for (cells->InitTraversal(); cells->GetNextCell(size, corners);)
      for (vtkIdType i = 0; i < size; ++i)
        if (corners[i] < 0 || corners[i] >= data->GetNumberOfPoints())
          throw FileError(path, "names point " + std::to_string(corners[i]) + "; it has " +
                                    std::to_string(data->GetNumberOfPoints()) + " points");
  }
}

template <class Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string& path, int& merged) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are ours to tell
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh: " + reading.reason());
  check_corners(path, reader->GetOutput());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(reader->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  vtkNew<vtkCleanPolyData> clean;  // merges equal points, also of texture seams and STL's loose corners
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0);
  clean->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh: " + reading.reason());
  merged =
      static_cast<int>(triangles->GetOutput()->GetNumberOfPoints() - clean->GetOutput()->GetNumberOfPoints());
  return clean->GetOutput();
}

bool is_ply_type(const std::string& word) {
  static const char* known[] = {"char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
                                "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

/// Whether a line of a .ply's header is one that VTK's reader survives; counts the elements it announces.
bool is_ply_line(const std::string& line, std::size_t& elements) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.empty()) return false;
  if (words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format") return elements == 0 && words.size() == 3;
  if (words[0] == "element" && words.size() == 3) {
    std::size_t count = 0;
    const bool number = static_cast<bool>(std::istringstream(words[2]) >> count);
    elements += count;
    return number && count < std::size_t{1} << 31;
  }
  if (words[0] != "property" || elements == 0) return false;
  if (words.size() == 3) return is_ply_type(words[1]);
  return words.size() == 5 && words[1] == "list" && is_ply_type(words[2]) && is_ply_type(words[3]);
}

/// The rows of a text .ply's body as its header announces them, each a line of words enough.
void check_ply_rows(const std::string& path, const std::string& header, const std::string& body) {
  std::istringstream announced(header), rows(body);
  struct Element {
    std::size_t count;
    std::vector<bool> lists;
  };
  std::vector<Element> elements;
  for (std::string line; std::getline(announced, line);) {
    std::istringstream in(line);
    std::string word, second;
    in >> word >> second;
    if (word == "element") in >> elements.emplace_back().count;
    if (word == "property") elements.back().lists.push_back(second == "list");
  }
  std::string line;
  std::getline(rows, line);  // what follows end_header
  for (const Element& element : elements)
    for (std::size_t row = 0; row < element.count; ++row) {
      std::getline(rows, line);
      std::istringstream in(line);
      double number = 0;
      for (const bool list : element.lists) {
        in >> number;
        if (list && in && !(number >= 0 && number < 1e6)) in.setstate(std::ios::failbit);
        for (double left = list ? number : 0, x = 0; in && left > 0; --left) in >> x;
      }
      if (!in || !rows)
        throw FileError(path, "has a row that is none of its elements: '" + line.substr(0, 60) + "'");
    }
}

/// VTK's reader of .ply crashes on headers that are not one, or where the body ends early: look first.
void check_ply(const std::string& path) {
  const std::string text = read_text_file(path);
  const auto end = text.find("end_header");
  if (!text.starts_with("ply") || end == std::string::npos)
    throw FileError(path, "has no header of a .ply file");
  std::istringstream header(text.substr(0, end));
  std::size_t elements = 0;
  std::string line;
  std::getline(header, line);
  for (int number = 2; std::getline(header, line); ++number)
    if (!is_ply_line(line, elements))
      throw FileError(path, "line " + std::to_string(number) + " is none of a .ply file's header: '" +
                                line.substr(0, 60) + "'");
  // The names that VTK's reader knows, in the elements that it expects them in; it crashes without.
  const auto face = std::min(text.find("element face "), end);
  const auto has = [&](const std::string& property, std::size_t from, std::size_t to) {
    const auto at = text.find(property, from);
    return at < to && std::isspace(static_cast<unsigned char>(text[at + property.size()]));
  };
  const bool points = has(" x", 0, face) && has(" y", 0, face) && has(" z", 0, face);
  const bool corners = has(" vertex_indices", face, end) || has(" vertex_index", face, end);
  if (!points || !corners || text.find("element vertex ") > face)
    throw FileError(path, "needs elements 'vertex' with x, y, z and then 'face' with a list vertex_indices");
  // Every element takes a line of text, or a byte at least and usually many more.
  const bool ascii = text.find("format ascii") < end;
  const std::size_t there = ascii ? static_cast<std::size_t>(std::count(
                                        text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), '\n'))
                                  : text.size() - end;
  if (elements == 0 || there < elements)
    throw FileError(path, "ends before the elements its header promises");
  if (ascii) check_ply_rows(path, text.substr(0, end), text.substr(end));
}

/// A binary .stl says how many triangles it holds; VTK's reader takes fewer without a word.
void check_stl(const std::string& path) {
  const std::string bytes = read_text_file(path);
  // VTK takes it for binary where a twentieth of its first 256 bytes is no text.
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 256));
  const auto odd = std::count_if(
      bytes.begin(), end, [](char c) { return (c < 32 || c > 126) && c != '\n' && c != '\r' && c != '\t'; });
  const bool text = 20 * odd < end - bytes.begin();
  if (text && bytes.starts_with("solid") && bytes.find("facet") != std::string::npos) return;
  std::uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
  const std::size_t promised = 84 + 50 * static_cast<std::size_t>(count);
  if (bytes.size() < promised)
    throw FileError(path, "is no whole .stl file: " + std::to_string(bytes.size()) +
                              " bytes, where its header promises " + std::to_string(promised));
}

vtkSmartPointer<vtkPolyData> read_any(const std::string& path, int& merged) {
  const std::string ending = ending_of(path);
  const bool known = ending == ".stl" || ending == ".obj" || ending == ".ply" || ending == ".vtp";
  if (known && !std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
  if (ending == ".ply") check_ply(path);
  if (ending == ".stl") check_stl(path);
  if (ending == ".stl") return read_with<vtkSTLReader>(path, merged);
  if (ending == ".obj") return read_with<vtkOBJReader>(path, merged);
  if (ending == ".ply") return read_with<vtkPLYReader>(path, merged);
  if (ending == ".vtp") return read_with<vtkXMLPolyDataReader>(path, merged);
  throw InputError(path + ": unknown ending '" + ending + "' of a mesh; known are .stl .obj .ply .vtp");
}

vtkSmartPointer<vtkPolyData> to_vtk(const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  for (const PointArray& array : arrays) {
    CLEFT_CHECK(array.values.size(), ==, mesh.points.size() * array.components);
    vtkNew<vtkDoubleArray> values;
    values->SetName(array.name.c_str());
    values->SetNumberOfComponents(array.components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(mesh.points.size()));
    std::copy(array.values.begin(), array.values.end(), values->GetPointer(0));
    data->GetPointData()->AddArray(values);
  }
  return data;
}

template <class Writer>
void write_with(const vtkNew<Writer>& writer, vtkPolyData* data, const std::string& path) {
  OutputFile file(path);
  const VtkListener writing(writer.Get());
  writer->SetFileName(file.path().c_str());
  writer->SetInputData(data);
  if (writer->Write() == 0 || writing.failed())
    throw std::runtime_error(path + ": could not be written: " + writing.reason());
  file.commit();
}

}  // namespace

SurfaceMesh read_mesh(const std::string& path, MeshReport* told) {
  MeshReport report;
  const auto data = read_any(path, report.merged_points);
  SurfaceMesh mesh;
  std::vector<int> number(data->GetNumberOfPoints(), -1);
  vtkCellArray* cells = data->GetPolys();
  vtkIdType size;
  const vtkIdType* corners;
  for (cells->InitTraversal(); cells->GetNextCell(size, corners);) {
    if (size != 3) continue;
    Vec3 p[3];
    for (int i = 0; i < 3; ++i) {
      data->GetPoint(corners[i], &p[i].x);
      if (!std::isfinite(p[i].x + p[i].y + p[i].z))
        throw FileError(path, "point " + std::to_string(corners[i]) + " is not a number");
    }
    if (norm(cross(p[1] - p[0], p[2] - p[0])) == 0) {
      ++report.degenerate_triangles;
      continue;
    }
    auto& triangle = mesh.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      int& n = number[corners[i]];
      if (n < 0) n = static_cast<int>(mesh.points.size()), mesh.points.push_back(p[i]);
      triangle[i] = n;
    }
  }
  if (mesh.triangles.empty()) throw FileError(path, "has no triangles");
  mesh = repaired(mesh, report);
  if (told) *told = report;
  return mesh;
}

void check_mesh_ending(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending != ".vtp" && ending != ".obj" && ending != ".stl")
    throw InputError(path + ": unknown ending '" + ending + "' of a mesh to write; known are .vtp .obj .stl");
}

void write_mesh(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  check_mesh_ending(path);
  const std::string ending = ending_of(path);
  if (ending == ".vtp") {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetDataModeToBinary();  // raw appended data are no XML: ParaView with a strict parser cannot read
                                    // them
    write_with(writer, to_vtk(mesh, arrays), path);
  } else if (ending == ".obj") {
    write_with(vtkNew<vtkOBJWriter>(), to_vtk(mesh, {}), path);
  } else {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    write_with(writer, to_vtk(mesh, {}), path);
  }
}

}  // namespace cleft
