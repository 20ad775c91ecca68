// Series in a VTKHDF file, and around through the commands.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class ImportVtkHdf : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const Plate plate{Plate::Cells::hexahedra, {}};

  /// A snapshot of the plate, by another name than what Imported writes.
  std::string snapshot() {
    const Imported imported(folder, plate.series().write(folder), {"displacement", "stress"});
    return folder.write("first.h5", read_text(folder / "case.h5"));
  }
  static std::string read_text(const std::string& file);

  static void expect_same(const Imported& imported, const std::string& file) {
    const SnapshotReader expected(file);
    const Snapshot &a = imported.snapshot(), &b = expected.snapshot();
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.cell_types, b.cell_types);
    EXPECT_EQ(a.connectivity, b.connectivity);
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.released, b.released);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.times, b.times);
    EXPECT_EQ(a.smallest_gap, b.smallest_gap);
    for (std::size_t j = 0; j < a.frames(); ++j) {
      EXPECT_EQ(imported.reader.displacement(j), expected.displacement(j));
      EXPECT_EQ(imported.reader.point_array({"stress", 6, true}, j),
                expected.point_array({"stress", 6, true}, j));
    }
  }
};

std::string ImportVtkHdf::read_text(const std::string& file) {
  std::string bytes;
  if (std::FILE* f = std::fopen(file.c_str(), "rb")) {
    char block[4096];
    for (std::size_t n; (n = std::fread(block, 1, sizeof block, f)) > 0;) bytes.append(block, n);
    std::fclose(f);
  }
  return bytes;
}

}  // namespace

TEST_F(ImportVtkHdf, ASnapshotImportsAsItself) {
  const std::string first = snapshot();
  expect_same(Imported(folder, first, {"displacement", "stress"}), first);
}

TEST_F(ImportVtkHdf, AnExportImportsAsItself) {
  const std::string first = snapshot();
  expect_success(run_cleft("export", {first, "--paraview", folder / "out.pvd"}));
  expect_same(Imported(folder, folder / "out.pvd", {"displacement", "stress"}), first);
}

/// As other writers do: every step with a mesh of its own, and numbers of any width.
TEST_F(ImportVtkHdf, AMeshAStepIsRead) {
  const SourceSeries series = plate.series();
  const auto points = static_cast<std::int64_t>(series.mesh.points.size()),
             cells = static_cast<std::int64_t>(series.mesh.cell_types.size()),
             corners = static_cast<std::int64_t>(series.mesh.connectivity.size());
  const std::string path = folder / "steps.vtkhdf";
  const auto write = [&](bool same_cells) {
    h5::File file = h5::File::create(path);
    file.create_group("/VTKHDF");
    file.write_integers("/VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
    file.write_text("/VTKHDF", "Type", "UnstructuredGrid");
    std::vector<double> places, displacement;
    std::vector<std::int32_t> offsets, connectivity;
    std::vector<std::uint8_t> types;
    std::map<std::string, std::vector<std::int64_t>> rows;
    for (std::int64_t j = 0; j < 5; ++j) {
      for (const Vec3& p : series.mesh.points) places.insert(places.end(), {p.x, p.y, p.z});
      offsets.insert(offsets.end(), series.mesh.cell_offsets.begin(), series.mesh.cell_offsets.end());
      connectivity.insert(connectivity.end(), series.mesh.connectivity.begin(),
                          series.mesh.connectivity.end());
      if (j == 3 && !same_cells)
        std::swap(connectivity[connectivity.size() - 1], connectivity[connectivity.size() - 2]);
      types.insert(types.end(), series.mesh.cell_types.begin(), series.mesh.cell_types.end());
      const auto& values = series.fields[0].frames[4 - j];  // backwards
      displacement.insert(displacement.end(), values.begin(), values.end());
      rows["NumberOfPoints"].push_back(points), rows["NumberOfCells"].push_back(cells);
      rows["NumberOfConnectivityIds"].push_back(corners);
      rows["Steps/PartOffsets"].push_back(j), rows["Steps/NumberOfParts"].push_back(1);
      rows["Steps/PointOffsets"].push_back(j * points), rows["Steps/CellOffsets"].push_back(j * cells);
      rows["Steps/ConnectivityIdOffsets"].push_back(j * corners);
      rows["Steps/PointDataOffsets/displacement"].push_back((4 - j) * points);
    }
    for (const auto& [name, numbers] : rows)
      file.write<std::int64_t>("/VTKHDF/" + name, numbers, {numbers.size()});
    file.write<double>("/VTKHDF/Steps/Values", series.times, {5});
    file.write<double>("/VTKHDF/Points", places, {places.size() / 3, 3});
    file.write<std::uint8_t>("/VTKHDF/Types", types, {types.size()});
    file.write<std::int32_t>("/VTKHDF/Offsets", offsets, {offsets.size()});
    file.write<std::int32_t>("/VTKHDF/Connectivity", connectivity, {connectivity.size()});
    file.write<double>("/VTKHDF/PointData/displacement", displacement, {displacement.size() / 3, 3});
    file.close();
  };
  write(true);
  const Imported imported(folder, path, {"displacement"});
  EXPECT_EQ(imported.snapshot().points, plate.local);
  for (std::size_t j = 0; j < 5; ++j)
    for (std::size_t n = 0; n < plate.local.size(); ++n)
      ASSERT_EQ(imported.reader.displacement(j)[n], plate.displacement(n, j));
  write(false);
  try {
    const Imported other(folder, path, {"displacement"});
    ADD_FAILURE() << "other cells went unnoticed";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("(frame 3): has other cells than frame 0"), std::string::npos)
        << e.what();
  }
}

/// What follows works on what was written.
TEST_F(ImportVtkHdf, TheCommandTellsWhatInfoAndCheckFind) {
  const std::string series = plate.series().write(folder);
  const auto told = nlohmann::json::parse(
      expect_success(run_cleft("import", {"--field", "displacement,temperature", series, "--out",
                                          folder / "a.h5", "--break", "0,-1,0,0", "--json"}))
          .output);
  EXPECT_EQ(told["frames"], 5);
  EXPECT_EQ(told["fields"], (std::vector<std::string>{"displacement", "temperature"}));
  EXPECT_EQ(told["pairs"], told["released"]);
  EXPECT_EQ(told["cut"]["length"], 16);
  EXPECT_EQ(told["duration"], 5);
  EXPECT_EQ(told["w"], (std::vector<double>{0, 0, 1}));
  expect_success(run_cleft("check", {folder / "a.h5"}));
  const auto info =
      nlohmann::json::parse(expect_success(run_cleft("info", {folder / "a.h5", "--json"})).output);
  EXPECT_EQ(info["import"]["source"], "series.pvd");
  EXPECT_EQ(info["import"]["time_start"], 3);
  EXPECT_EQ(info["import"]["break"], told["break"]);
  EXPECT_EQ(info["arrays"], (std::vector<std::string>{"temperature"}));
  EXPECT_EQ(info["duration"], 5);
}

}  // namespace cleft
