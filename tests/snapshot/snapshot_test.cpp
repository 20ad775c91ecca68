#include "solver/snapshot/snapshot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "tests/snapshot/point_array.h"
#include "tests/support/damage.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// A wedge under a triangle, with one duplicated node and three frames.
Snapshot small_snapshot() {
  Snapshot s;
  s.points = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  s.cell_types = {Snapshot::triangle, Snapshot::wedge};
  s.cell_offsets = {0, 3, 9};
  s.connectivity = {3, 4, 5, 3, 4, 5, 0, 1, 2};
  s.foundation_triangles = {{0, 1, 2}};
  s.foundation_quads = {{0, 1, 4, 3}};
  s.pairs = {{4, 6}};
  s.released = {0, 0, 1};
  s.position = {-1, 0, 1};
  s.cut_start = -1, s.cut_length = 2, s.cut_depth = 0.5;
  s.times = {0, 1, 2};
  s.smallest_gap = {0, 0, 0.25}, s.residual_equilibrium = {1e-15, 2e-15, 3e-15},
  s.residual_closure = {0, 0, 0};
  s.parameters.set("skin.thickness", 1.5);
  s.parameters.set("cut.frames", "column");
  s.case_hash = "0123456789abcdef";
  return s;
}

std::vector<Vec3> frame(int j) {
  std::vector<Vec3> d(7);
  for (int n = 0; n < 7; ++n) d[n] = {j + n / 7.0, j * n / 3.0, -1.0 * j};
  return d;
}

std::string write(const TemporaryFolder& folder, const Snapshot& s) {
  SnapshotWriter writer(folder / "case.h5", s);
  for (int j = 0; j < 3; ++j) writer.write_frames(j, frame(j));
  writer.finish(s);
  return folder / "case.h5";
}

bool same(const SnapshotReader& reader) {
  const Snapshot &a = reader.snapshot(), b = small_snapshot();
  for (int j = 0; j < 3; ++j)
    if (reader.displacement(j) != frame(j)) return false;
  return a.points == b.points && a.cell_types == b.cell_types && a.cell_offsets == b.cell_offsets &&
         a.connectivity == b.connectivity && a.foundation_triangles == b.foundation_triangles &&
         a.foundation_quads == b.foundation_quads && a.pairs == b.pairs && a.released == b.released &&
         a.position == b.position && a.times == b.times && a.smallest_gap == b.smallest_gap &&
         a.residual_equilibrium == b.residual_equilibrium && a.residual_closure == b.residual_closure &&
         a.parameters == b.parameters && a.case_hash == b.case_hash && a.cut_start == b.cut_start &&
         a.cut_length == b.cut_length && a.cut_depth == b.cut_depth;
}

}  // namespace

TEST(Snapshot, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const SnapshotReader reader(write(folder, small_snapshot()));
  EXPECT_TRUE(same(reader));
  EXPECT_EQ(reader.displacement(2, 3, 2), (std::vector<Vec3>{frame(2)[3], frame(2)[4]}));
  EXPECT_EQ(reader.snapshot().skin(), (std::vector<std::array<int, 3>>{{3, 4, 5}}));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Snapshot, ParametersOfUnknownNamesAreKept) {
  const TemporaryFolder folder;
  Snapshot s = small_snapshot();
  s.parameters.set("speed", 3.);
  s.parameters.set("cut.contact", "maybe");
  s.parameters.set("skin.initial_stress_stiffness", "true");
  s.parameters.set("skin.prestress_uv", 0.25);
  const RecordedParameters read = SnapshotReader(write(folder, s)).snapshot().parameters;
  EXPECT_EQ(read, s.parameters);
  EXPECT_EQ(read.find("cut.contact"), Value("maybe"));
  EXPECT_TRUE(read->skin.initial_stress_stiffness);
  EXPECT_EQ(read->skin.prestress.uv, 0.25);
}

TEST(Snapshot, ImportedDataNeedNoCutNorResiduals) {
  const TemporaryFolder folder;
  Snapshot s = small_snapshot();
  s.cell_types = {5, 73};  // a type that no other part knows
  s.foundation_triangles.clear(), s.foundation_quads.clear(), s.pairs.clear(), s.parameters = {};
  s.released = {0, 0, 0};
  s.cut_start = s.cut_length = s.cut_depth = 0;
  s.residual_equilibrium.clear(), s.residual_closure.clear();
  s.source = {"wave.pvd", {1, 2, 3}, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, -4.5, "none"};
  const SnapshotArray pressure = {"pressure", 1, true}, stress = {"stress", 6, true};
  const auto numbers = [](std::size_t count, std::size_t frame) {
    std::vector<double> list(count);
    for (std::size_t i = 0; i < count; ++i) list[i] = 1.0 / (1.0 + static_cast<double>(i + 100 * frame));
    return list;
  };
  SnapshotWriter writer(folder / "case.h5", s, {pressure, stress});
  for (std::size_t j = 0; j < 3; ++j) {  // no displacement: its rows are 0
    writer.write_array(pressure, j, numbers(7, j));
    writer.write_array(stress, j, numbers(42, j));
  }
  writer.finish(s);
  check_snapshot(folder / "case.h5");

  const SnapshotReader reader(folder / "case.h5");
  const Snapshot& read = reader.snapshot();
  ASSERT_TRUE(read.source);
  EXPECT_EQ(read.source->file, "wave.pvd");
  EXPECT_EQ(read.source->origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(read.source->axes, s.source->axes);
  EXPECT_EQ(read.source->time_start, -4.5);
  EXPECT_EQ(read.source->break_plane, "none");
  EXPECT_TRUE(read.pairs.empty() && read.residual_closure.empty() && read.parameters.empty());
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(reader.displacement(j), std::vector<Vec3>(7));
    EXPECT_EQ(reader.point_array(pressure, j), numbers(7, j));
    EXPECT_EQ(reader.point_array(stress, j), numbers(42, j));
  }
}

TEST(Snapshot, FurtherArraysOfThePointsAreRead) {
  const TemporaryFolder folder;
  const std::string file = write(folder, small_snapshot());
  EXPECT_TRUE(SnapshotReader(file).point_arrays().empty());
  std::vector<double> numbers(7 * 3 * 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 1.0 / (1.0 + i);
  add_point_array(file, "compliance", numbers, {7});
  add_point_array(file, "dent", numbers, {7, 3});
  add_point_array(file, "displacement_per_skin.prestress_v", numbers, {21, 3});
  add_point_array(file, "gap", numbers, {21});
  EXPECT_THROW(check_snapshot(file), FileError) << "arrays that others add have no checksums, but are read";

  const SnapshotReader reader(file);
  EXPECT_TRUE(same(reader));
  const auto arrays = reader.point_arrays();
  ASSERT_EQ(arrays.size(), 4u);
  const auto expect = [&](int i, const char* name, std::size_t components, bool varies) {
    EXPECT_EQ(arrays[i].name, name);
    EXPECT_EQ(arrays[i].components, components);
    EXPECT_EQ(arrays[i].varies, varies);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto* first = &numbers[varies ? j * 7 * components : 0];
      EXPECT_EQ(reader.point_array(arrays[i], j), std::vector<double>(first, first + 7 * components));
    }
  };
  expect(0, "compliance", 1, false);
  expect(1, "dent", 3, false);
  expect(2, "displacement_per_skin.prestress_v", 3, true);
  expect(3, "gap", 1, true);
}

TEST(Snapshot, ArraysThatDoNotFitThePointsAreNamed) {
  for (const h5::Shape& shape : std::vector<h5::Shape>{{6}, {14, 3}, {3, 7}, {7, 1, 1}, {1, 21}}) {
    const TemporaryFolder folder;
    const std::string file = write(folder, small_snapshot());
    add_point_array(file, "odd", std::vector<double>(64), shape);
    EXPECT_THROW(check_snapshot(file), FileError);
    try {
      SnapshotReader(file).point_arrays();
      ADD_FAILURE() << "accepted";
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find("PointData/odd must have a row a point (7)"), std::string::npos)
          << e.what();
    }
  }
  const TemporaryFolder folder;
  const std::string file = write(folder, small_snapshot());
  add_point_array(file, "integers", std::vector<double>(7), {7}, H5T_NATIVE_INT);
  const SnapshotReader reader(file);
  EXPECT_THROW(reader.point_array(reader.point_arrays().at(0), 0), FileError);
}

TEST(Snapshot, AnUnfinishedOneLeavesNothing) {
  const TemporaryFolder folder;
  { SnapshotWriter writer(folder / "case.h5", small_snapshot()); }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Snapshot, DamageIsNoticed) {
  const TemporaryFolder folder;
  std::optional<SnapshotReader> reader;
  EXPECT_EQ(unnoticed_damages(
                write(folder, small_snapshot()), 700,
                [&](const std::string& file) {
                  check_snapshot(file);
                  reader.emplace(file);
                },
                [&] { return same(*reader); }),
            0);
}

TEST(Snapshot, ADisplacementThatIsNoNumberIsTold) {
  const TemporaryFolder folder;
  SnapshotWriter writer(folder / "case.h5", small_snapshot());
  for (int j = 0; j < 3; ++j) {
    std::vector<Vec3> d = frame(j);
    if (j == 1) d[3].z = std::nan("");
    writer.write_frames(j, d);
  }
  writer.finish(small_snapshot());
  EXPECT_THROW(check_snapshot(folder / "case.h5"), FileError);
}

TEST(Snapshot, DamageInWhatOnlyOtherProgramsReadIsFoundByCheck) {
  const TemporaryFolder folder;
  const std::string file = write(folder, small_snapshot());
  std::string bytes = read_text_file(file);
  // /VTKHDF/Steps/PointDataOffsets/displacement: rows 0, 7, 14 as 64-bit integers stand nowhere else.
  const std::int64_t rows[] = {0, 7, 14};
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(rows), sizeof rows));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 8] ^= 1;
  EXPECT_THROW(check_snapshot(folder.write("bad.h5", bytes)), FileError);
}

TEST(Snapshot, ContradictionsAreNamed) {
  const auto refuse = [](auto change, const std::string& part) {
    const TemporaryFolder folder;
    Snapshot s = small_snapshot();
    change(s);
    const std::string file = write(folder, s);
    try {
      SnapshotReader reader(file);
      ADD_FAILURE() << "accepted: " << part;
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  refuse([](Snapshot& s) { s.connectivity[0] = 7; }, "Connectivity");
  refuse([](Snapshot& s) { s.cell_offsets[1] = 10; }, "Offsets");
  refuse([](Snapshot& s) { s.cell_offsets[1] = 2; }, "has 2 corners");
  refuse([](Snapshot& s) { s.cut_length = -1; }, "positive");
  refuse([](Snapshot& s) { s.position[1] = std::nan(""); }, "position");
  refuse([](Snapshot& s) { s.pairs[0][1] = -1; }, "pairs");
  refuse([](Snapshot& s) { s.released = {0, 1, 0}; }, "released");
  refuse([](Snapshot& s) { s.released = {1, 1, 1}; }, "frame 0");
  refuse([](Snapshot& s) { s.released = {0, 1, 2}; }, "released");
  refuse([](Snapshot& s) { s.times = {0, 2, 2}; }, "Steps/Values");
  refuse([](Snapshot& s) { s.foundation_quads[0][0] = 99; }, "quads");

  const SnapshotSource source = {"a.pvd", {}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0, "none"};
  refuse([&](Snapshot& s) { s.source = source, s.cut_length = -1; }, "must not be negative");
  refuse([&](Snapshot& s) { s.source = source, s.source->origin.x = std::nan(""); }, "origin");
  refuse([&](Snapshot& s) { s.source = source, s.source->axes[2] = {0, 0, -1}; }, "right-handed");
  refuse([&](Snapshot& s) { s.source = source, s.source->axes[0] = {1.01, 0, 0}; }, "right-handed");
}

}  // namespace cleft
