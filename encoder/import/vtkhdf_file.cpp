#include <algorithm>

#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace {

/// Where the rows of a part of a step begin in each dataset.
struct StepRows {
  hsize_t points, cells, offsets, corners;  ///< the first of each
  hsize_t point_count, cell_count, corner_count;
};

class VtkHdfFile : public FrameFiles {
 public:
  explicit VtkHdfFile(const std::string& path) : file_(h5::File::open(path)) {
    if (!file_.has_attribute("/VTKHDF", "Type") || file_.read_text("/VTKHDF", "Type") != "UnstructuredGrid")
      throw FileError(path, "is no VTKHDF file of an unstructured grid");
    if (!file_.has("/VTKHDF/Steps/Values"))
      throw FileError(path, "holds one frame, without /VTKHDF/Steps; a series needs 2");
    times_ = file_.read<double>("/VTKHDF/Steps/Values", {0});
  }

  std::vector<std::string> files() const override { return {file_.path()}; }
  const std::vector<double>& times() const override { return times_; }
  const std::string& file(std::size_t) const override { return file_.path(); }
  std::vector<std::string> point_arrays(std::size_t) const override {
    return file_.members("/VTKHDF/PointData");
  }
  std::vector<std::string> cell_arrays(std::size_t) const override {
    return file_.members("/VTKHDF/CellData");
  }

  bool in_pieces() const override { return file_.has("/VTKHDF/Steps/NumberOfParts") && parts_of(0) > 1; }

  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    const hsize_t parts = parts_of(frame), first_part = step("PartOffsets", frame, 0);
    StepRows rows{step("PointOffsets", frame, 0),
                  step("CellOffsets", frame, 0),
                  0,
                  step("ConnectivityIdOffsets", frame, 0),
                  0,
                  0,
                  0};
    rows.offsets = rows.cells + first_part;  // a part of C cells has C + 1 offsets
    const StepRows first = rows;
    SourceFrame result;
    for (hsize_t part = first_part; part < first_part + parts; ++part) {
      rows.point_count = count("NumberOfPoints", part), rows.cell_count = count("NumberOfCells", part);
      rows.corner_count = count("NumberOfConnectivityIds", part);
      SourceFrame piece = part_at(frame, rows, first, wanted);
      if (part == first_part)
        result = std::move(piece);
      else
        append(result, piece, file_.path());
      rows.points += rows.point_count, rows.cells += rows.cell_count;
      rows.offsets += rows.cell_count + 1, rows.corners += rows.corner_count;
    }
    return result;
  }

 private:
  /// An integer for each step, or `otherwise` if the file has none.
  hsize_t step(const std::string& name, std::size_t frame, hsize_t otherwise) const {
    const std::string dataset = "/VTKHDF/Steps/" + name;
    if (!file_.has(dataset)) return otherwise;
    const auto numbers = file_.read<std::int64_t>(dataset);
    if (numbers.size() != times_.size() || numbers[frame] < 0)
      throw FileError(file_.path(), dataset + " must have a row number a step");
    return static_cast<hsize_t>(numbers[frame]);
  }

  hsize_t count(const std::string& name, hsize_t part) const {
    const auto numbers = file_.read<std::int64_t>("/VTKHDF/" + name, {0});
    if (part >= numbers.size() || numbers[part] < 0)
      throw FileError(file_.path(),
                      "/VTKHDF/" + name + " does not say how many part " + std::to_string(part) + " has");
    return static_cast<hsize_t>(numbers[part]);
  }

  hsize_t parts_of(std::size_t frame) const {
    const hsize_t all = file_.read<std::int64_t>("/VTKHDF/NumberOfPoints", {0}).size();
    const hsize_t parts = step("NumberOfParts", frame, all);
    if (parts == 0 || parts > all)
      throw FileError(file_.path(), "frame " + std::to_string(frame) + " is of " + std::to_string(parts) +
                                        " parts, where the file has " + std::to_string(all));
    return parts;
  }

  /// `first`: rows of the first part of the frame.
  SourceFrame part_at(std::size_t frame, const StepRows& rows, const StepRows& first,
                      const WantedArrays& wanted) const {
    SourceFrame result;
    SourceMesh& mesh = result.mesh;
    const SourceArray points = array_of("/VTKHDF/Points", rows.points, rows.point_count);
    if (points.components != 3) throw FileError(file_.path(), "/VTKHDF/Points must have 3 columns");
    for (std::size_t i = 0; i < points.values.size(); i += 3)
      mesh.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
    mesh.cell_types = list<std::uint8_t>("/VTKHDF/Types", rows.cells, rows.cell_count);
    mesh.cell_offsets = list<std::int64_t>("/VTKHDF/Offsets", rows.offsets, rows.cell_count + 1);
    mesh.connectivity = list<std::int64_t>("/VTKHDF/Connectivity", rows.corners, rows.corner_count);
    for (const std::string& name : wanted.points)
      result.arrays.push_back(
          array_of("/VTKHDF/PointData/" + name,
                   step("PointDataOffsets/" + name, frame, first.points) + (rows.points - first.points),
                   rows.point_count));
    for (const std::string& name : wanted.cells)
      result.cell_arrays.push_back(array_of(
          "/VTKHDF/CellData/" + name,
          step("CellDataOffsets/" + name, frame, first.cells) + (rows.cells - first.cells), rows.cell_count));
    return result;
  }

  void refuse_short(const std::string& name, hsize_t first, hsize_t count_of_rows) const {
    const h5::Shape shape = file_.shape(name);
    if (shape.empty() || shape.size() > 2 || first + count_of_rows > shape[0])
      throw FileError(file_.path(), name + " has fewer rows than its steps need");
  }

  template <class T>
  std::vector<T> list(const std::string& name, hsize_t first, hsize_t rows) const {
    refuse_short(name, first, rows);
    std::vector<T> values(rows);
    if (rows > 0) file_.read_rows<T>(name, first, rows, values);
    return values;
  }

  SourceArray array_of(const std::string& name, hsize_t first, hsize_t rows) const {
    refuse_short(name, first, rows);
    const h5::Shape shape = file_.shape(name);
    SourceArray array;
    array.components = shape.size() == 1 ? 1 : static_cast<int>(shape[1]);
    array.single = file_.element_size(name) <= sizeof(float);
    array.values.resize(rows * static_cast<hsize_t>(array.components));
    file_.read_rows<double>(name, first, rows, array.values);
    return array;
  }

  h5::File file_;
  std::vector<double> times_;
};

}  // namespace

std::unique_ptr<FrameFiles> open_vtkhdf(const std::string& path) {
  return std::make_unique<VtkHdfFile>(path);
}

}  // namespace cleft
