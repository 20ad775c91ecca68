#include <algorithm>

#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace {

/// Where a step's rows begin in each dataset.
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

  SourceFrame read(std::size_t frame, const std::vector<std::string>& arrays) const override {
    const StepRows rows = rows_of(frame);
    SourceFrame result;
    SourceMesh& mesh = result.mesh;
    const SourceArray points = array_of("/VTKHDF/Points", rows.points, rows.point_count);
    if (points.components != 3) throw FileError(file_.path(), "/VTKHDF/Points must have 3 columns");
    for (std::size_t i = 0; i < points.values.size(); i += 3)
      mesh.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
    mesh.cell_types = list<std::uint8_t>("/VTKHDF/Types", rows.cells, rows.cell_count);
    mesh.cell_offsets = list<std::int64_t>("/VTKHDF/Offsets", rows.offsets, rows.cell_count + 1);
    mesh.connectivity = list<std::int64_t>("/VTKHDF/Connectivity", rows.corners, rows.corner_count);
    for (const std::string& name : arrays)
      result.arrays.push_back(array_of("/VTKHDF/PointData/" + name,
                                       step("PointDataOffsets/" + name, frame, rows.points),
                                       rows.point_count));
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

  StepRows rows_of(std::size_t frame) const {
    const hsize_t part = step("PartOffsets", frame, 0);
    const hsize_t parts =
        step("NumberOfParts", frame, file_.read<std::int64_t>("/VTKHDF/NumberOfPoints", {0}).size());
    if (parts != 1)
      throw FileError(file_.path(), "frame " + std::to_string(frame) + " is of " + std::to_string(parts) +
                                        " parts; write each frame as one");
    const hsize_t cells = step("CellOffsets", frame, 0);
    return {step("PointOffsets", frame, 0),
            cells,
            cells + part,  // a part of C cells has C + 1 offsets
            step("ConnectivityIdOffsets", frame, 0),
            count("NumberOfPoints", part),
            count("NumberOfCells", part),
            count("NumberOfConnectivityIds", part)};
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
