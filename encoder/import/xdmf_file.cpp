// Series in .xdmf files, as FEniCS, FEniCSx and meshio write them: XML, with the numbers in HDF5 or in the
// text.
#include <vtkLogger.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <type_traits>

#include "base/error.h"
#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

using Element = vtkXMLDataElement*;

struct Topology {
  const char* name;
  std::uint8_t type;  ///< VTK's
  int nodes, code;    ///< code: in arrays of mixed cells
};

constexpr std::array<Topology, 18> topologies{{
    {"polyvertex", 1, 1, 1},
    {"polyline", 3, 2, 2},
    {"triangle", 5, 3, 4},
    {"quadrilateral", 9, 4, 5},
    {"tetrahedron", 10, 4, 6},
    {"pyramid", 14, 5, 7},
    {"wedge", 13, 6, 8},
    {"hexahedron", 12, 8, 9},
    {"edge_3", 21, 3, 34},
    {"triangle_6", 22, 6, 36},
    {"quadrilateral_8", 23, 8, 37},
    {"tetrahedron_10", 24, 10, 38},
    {"pyramid_13", 27, 13, 39},
    {"wedge_15", 26, 15, 40},
    {"hexahedron_20", 25, 20, 48},
    {"tri_6", 22, 6, 36},
    {"tet_10", 24, 10, 38},
    {"hex_20", 25, 20, 48},
}};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string attribute(Element element, const char* name, const char* otherwise = "") {
  const char* value = element->GetAttribute(name);
  return value ? value : otherwise;
}

bool is(Element element, const char* name) { return std::string(element->GetName()) == name; }

Element child(Element parent, const char* name) {
  for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
    if (is(parent->GetNestedElement(i), name)) return parent->GetNestedElement(i);
  return nullptr;
}

template <class Action>
void for_each_child(Element parent, const char* name, const Action& action) {
  for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
    if (is(parent->GetNestedElement(i), name)) action(parent->GetNestedElement(i));
}

/// What a file holds at one time.
struct GridAtTime {
  Element topology = nullptr, geometry = nullptr;
  std::map<std::string, Element> of_points, of_cells;
};

class XdmfFile : public FrameFiles {
 public:
  explicit XdmfFile(const std::string& path) : path_(path) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
    root_ = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    if (!root_ || !is(root_, "Xdmf")) throw FileError(path, "is no .xdmf file, or is damaged");
    visit(root_);
    for (const auto& [time, grid] : grids_) times_.push_back(time);
    if (times_.empty()) throw FileError(path, "holds no grids with a time");
    find_heavy_files();
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> all = {path_};
    all.insert(all.end(), heavy_.begin(), heavy_.end());
    return all;
  }
  const std::vector<double>& times() const override { return times_; }
  const std::string& file(std::size_t) const override { return path_; }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    return names(at(frame).of_points);
  }
  std::vector<std::string> cell_arrays(std::size_t frame) const override { return names(at(frame).of_cells); }

  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    const GridAtTime& grid = at(frame);
    const Element topology = grid.topology ? grid.topology : topology_,
                  geometry = grid.geometry ? grid.geometry : geometry_;
    if (!topology || !geometry)
      throw FileError(path_, "frame " + std::to_string(frame) + " has no Topology or no Geometry");
    SourceFrame result;
    read_points(geometry, result.mesh);
    read_cells(topology, result.mesh);
    for (const std::string& name : wanted.points)
      result.arrays.push_back(array_of(data_of(grid.of_points.at(name), "Attribute '" + name + "'")));
    for (const std::string& name : wanted.cells)
      result.cell_arrays.push_back(array_of(data_of(grid.of_cells.at(name), "Attribute '" + name + "'")));
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw FileError(path_, what); }

  const GridAtTime& at(std::size_t frame) const {
    return std::next(grids_.begin(), static_cast<std::ptrdiff_t>(frame))->second;
  }

  static std::vector<std::string> names(const std::map<std::string, Element>& arrays) {
    std::vector<std::string> all;
    all.reserve(arrays.size());
    for (const auto& [name, element] : arrays) all.push_back(name);
    return all;
  }

  /// Grids of all depths. Those that include the mesh of another have that of the first.
  void visit(Element parent) {
    for_each_child(parent, "Domain", [&](Element domain) { visit(domain); });
    for_each_child(parent, "Grid", [&](Element grid) {
      const std::string kind = lower(attribute(grid, "GridType", "Uniform"));
      if (kind == "collection" && lower(attribute(grid, "CollectionType")) == "spatial")
        refuse("grid '" + attribute(grid, "Name") +
               "' is a spatial collection; in ParaView: Merge Blocks, then Save Data as .pvd");
      if (kind != "uniform" && kind != "collection" && kind != "tree")
        refuse("grid '" + attribute(grid, "Name") + "' is of the unknown type '" + kind + "'");
      if (kind == "uniform") add(grid);
      visit(grid);
    });
  }

  void add(Element grid) {
    const Element topology = child(grid, "Topology"), geometry = child(grid, "Geometry");
    if (topology && geometry && !topology_) topology_ = topology, geometry_ = geometry;
    const Element time = child(grid, "Time");
    if (!time) return;
    const std::string where = "time of grid '" + attribute(grid, "Name") + "'";
    const double at = parse_number(attribute(time, "Value"), path_ + ": " + where);
    if (!std::isfinite(at)) refuse(where + " is not finite");
    GridAtTime& here = grids_[at];
    if (topology) here.topology = topology;
    if (geometry) here.geometry = geometry;
    for_each_child(grid, "Attribute", [&](Element array) {
      const std::string center = lower(attribute(array, "Center", "Node")), name = attribute(array, "Name");
      if (center != "node" && center != "cell") return;
      if (!(center == "node" ? here.of_points : here.of_cells).emplace(name, array).second)
        refuse("'" + name + "' is there twice at time " + attribute(time, "Value"));
    });
  }

  Element data_of(Element parent, const std::string& what) const {
    if (attribute(parent, "ItemType") == "FiniteElementFunction")
      refuse(what +
             " is a checkpoint of FEniCS, of no values at nodes; write it with XDMFFile.write(u, t) "
             "instead of write_checkpoint");
    const Element item = child(parent, "DataItem");
    if (!item) refuse(what + " has no DataItem");
    if (const std::string type = lower(attribute(item, "ItemType", "Uniform")); type != "uniform")
      refuse(what + " has a DataItem of type '" + type + "', and only Uniform is read");
    return item;
  }

  static std::vector<std::size_t> extents(Element item) {
    std::istringstream text(attribute(item, "Dimensions"));
    std::vector<std::size_t> all;
    for (std::size_t n; text >> n;) all.push_back(n);
    return all;
  }

  /// HDF5's file and dataset of an item; nothing where the numbers are in the text.
  std::optional<std::pair<std::string, std::string>> heavy(Element item) const {
    const std::string format = lower(attribute(item, "Format", "XML"));
    if (format == "xml") return {};
    if (format != "hdf")
      refuse("a DataItem is of the format '" + format + "', and only HDF and XML are read");
    std::string text = item->GetCharacterData() ? item->GetCharacterData() : "";
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    text.erase(std::remove_if(text.begin(), text.end(), blank), text.end());
    const auto colon = text.rfind(":/");
    if (colon == std::string::npos) refuse("a DataItem names '" + text + "', and no FILE.h5:/DATASET");
    return std::pair{(fs::path(path_).parent_path() / text.substr(0, colon)).string(),
                     text.substr(colon + 1)};
  }

  /// Finds the HDF5 files, which must exist.
  void find_heavy_files() {
    std::vector<Element> waiting{root_};
    while (!waiting.empty()) {
      const Element element = waiting.back();
      waiting.pop_back();
      for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
        waiting.push_back(element->GetNestedElement(i));
      if (!is(element, "DataItem") || lower(attribute(element, "ItemType", "Uniform")) != "uniform") continue;
      if (const auto at = heavy(element);
          at && std::find(heavy_.begin(), heavy_.end(), at->first) == heavy_.end()) {
        if (!fs::is_regular_file(at->first)) refuse("there is no file '" + at->first + "', which it names");
        heavy_.push_back(at->first);
      }
    }
  }

  /// As many numbers as the item's dimensions tell.
  template <class T>
  std::vector<T> numbers(Element item) const {
    std::vector<T> values;
    if (const auto at = heavy(item)) {
      values = h5::File::open(at->first).read<T>(at->second);
    } else {
      std::istringstream text(item->GetCharacterData() ? item->GetCharacterData() : "");
      for (std::string word; text >> word;) {
        const double value = parse_number(word, path_ + ": a DataItem");
        constexpr double largest = 9007199254740992;  // of the whole numbers that doubles hold exactly
        if (std::is_integral_v<T> && !(std::abs(value) <= largest)) refuse("'" + word + "' is no node");
        values.push_back(static_cast<T>(value));
      }
    }
    std::size_t count = 1;
    for (const std::size_t extent : extents(item)) count *= extent;
    if (values.size() != count)
      refuse("a DataItem of dimensions '" + attribute(item, "Dimensions") + "' holds " +
             std::to_string(values.size()) + " numbers");
    return values;
  }

  SourceArray array_of(Element item) const {
    const std::vector<std::size_t> shape = extents(item);
    SourceArray array;
    std::size_t columns = 1;
    for (std::size_t i = 1; i < shape.size(); ++i) columns *= shape[i];
    constexpr std::size_t most = 1000;
    if (columns == 0 || columns > most) refuse("an Attribute has " + std::to_string(columns) + " columns");
    array.components = static_cast<int>(columns);
    array.single = attribute(item, "Precision", "4") == "4";
    array.values = numbers<double>(item);
    return array;
  }

  void read_points(Element geometry, SourceMesh& mesh) const {
    const std::string kind =
        lower(attribute(geometry, "GeometryType", attribute(geometry, "Type", "XYZ").c_str()));
    if (kind != "xyz" && kind != "xy")
      refuse("a Geometry is of the type '" + kind + "', and only XYZ and XY are read");
    const std::size_t columns = kind.size();
    const std::vector<double> places = numbers<double>(data_of(geometry, "a Geometry"));
    if (places.size() % columns != 0)
      refuse("a Geometry has other than " + std::to_string(columns) + " columns");
    for (std::size_t i = 0; i < places.size(); i += columns)
      mesh.points.push_back({places[i], places[i + 1], columns == 3 ? places[i + 2] : 0});
  }

  void read_cells(Element topology, SourceMesh& mesh) const {
    const std::string kind = lower(attribute(topology, "TopologyType", attribute(topology, "Type").c_str()));
    const std::vector<std::int64_t> corners = numbers<std::int64_t>(data_of(topology, "a Topology"));
    mesh.cell_offsets = {0};
    const auto add = [&](const Topology& cell, std::size_t count, std::size_t first) {
      if (first + count > corners.size()) refuse("a Topology ends within a cell");
      mesh.cell_types.push_back(cell.type);
      for (std::size_t i = first; i < first + count; ++i) mesh.connectivity.push_back(corners[i]);
      mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
    };
    if (kind == "mixed") {
      for (std::size_t i = 0; i < corners.size();) {
        const auto cell = std::find_if(topologies.begin(), topologies.end(),
                                       [&](const Topology& t) { return t.code == corners[i]; });
        if (cell == topologies.end()) refuse("a cell is of the unknown type " + std::to_string(corners[i]));
        const std::size_t first = i + (cell->code <= 2 ? 2 : 1);  // these tell their number of nodes
        if (first > i + 1 && (first > corners.size() || corners[i + 1] != cell->nodes))
          refuse("a line or vertex has other than " + std::to_string(cell->nodes) + " nodes");
        add(*cell, static_cast<std::size_t>(cell->nodes), first);
        i = first + static_cast<std::size_t>(cell->nodes);
      }
      return;
    }
    const auto cell =
        std::find_if(topologies.begin(), topologies.end(), [&](const Topology& t) { return kind == t.name; });
    if (cell == topologies.end())
      refuse("a Topology is of the type '" + kind + "', which is not read; in ParaView: Save Data as .pvd");
    const auto count = static_cast<std::size_t>(cell->nodes);
    if (corners.size() % count != 0)
      refuse("a Topology of " + kind + "s has " + std::to_string(corners.size()) + " corners");
    for (std::size_t i = 0; i < corners.size(); i += count) add(*cell, count, i);
  }

  std::string path_;
  vtkSmartPointer<vtkXMLDataElement> root_;
  Element topology_ = nullptr, geometry_ = nullptr;  ///< the first of all
  std::map<double, GridAtTime> grids_;
  std::vector<double> times_;
  std::vector<std::string> heavy_;
};

}  // namespace

std::unique_ptr<FrameFiles> open_xdmf(const std::string& path) { return std::make_unique<XdmfFile>(path); }

}  // namespace cleft
