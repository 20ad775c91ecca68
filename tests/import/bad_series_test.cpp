// Series that cannot be imported: what is wrong, where, and no file left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/text.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class BadSeries : public testing::Test {
 protected:
  const TemporaryFolder in, out;
  const SourceSeries good = Plate(Plate::Cells::hexahedra, {}).series();

  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    std::vector<std::string> all = arguments;
    if (std::find(all.begin(), all.end(), "--out") == all.end())
      all.insert(all.end(), {"--out", out / "case.h5"});
    const Outcome outcome = run_cleft("import", all);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos)
          << "missing '" << part << "' in: " << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    EXPECT_EQ(out.entries(), 0) << "something was left behind";
  }
  void expect_refused(const SourceSeries& series, const std::vector<std::string>& parts) {
    expect_refused({series.write(in), "--field", "displacement"}, parts);
  }
  std::string pvd(const std::string& entries) const {
    return in.write("list.pvd",
                    "<VTKFile type=\"Collection\"><Collection>" + entries + "</Collection></VTKFile>");
  }
};

}  // namespace

TEST_F(BadSeries, ParametersThatAreNone) {
  const auto refused = [&](const std::vector<std::string>& settings, const std::string& why) {
    std::vector<std::string> arguments{good.write(in), "--field", "displacement"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    expect_refused(arguments, {settings.back().substr(0, settings.back().find('=')), why});
  };
  refused({"skin.thickness"}, "is not NAME=VALUE");
  refused({"skin.thickness=thick"}, "'thick' is not a number");
  refused({"skin.thickness=1.5", "skin.thickness=2"}, "is given twice");
}

TEST_F(BadSeries, FieldsThatAreNotThere) {
  const std::string series = good.write(in);
  expect_refused({series, "--field", "displacment"},
                 {"--field displacment", "series_0.vtu (frame 0)", "did you mean 'displacement'",
                  "there are: displacement, stress, temperature"});
  expect_refused({series, "--field", "stress:displacement"}, {"has 6 components", "a displacement has 3"});
  expect_refused({series, "--field", "stress,temperature:stress"}, {"'stress' is named twice"});
  expect_refused({series, "--field", "stress:a/b"}, {"'a/b'"});
  expect_refused({series, "--field", ":a"}, {"':a'"});
  expect_refused({series}, {"--field"});

  SourceSeries odd = good;
  for (auto& values : odd.fields[1].frames) values.resize(odd.mesh.points.size() * 4);
  odd.fields[1].components = 4;
  expect_refused({odd.write(in), "--field", "stress"},
                 {"has 4 components", "scalars (1), vectors (3, or 2)"});

  in.write("series_2.vtu", [&] {
    SourceSeries less = good;
    less.fields.erase(less.fields.begin());
    return less.vtu(2);
  }());
  expect_refused({series, "--field", "displacement"}, {"series_2.vtu (frame 2)", "holds no such array"});

  std::string text = read_text_file(in / "series_0.vtu");  // of cells
  const auto begin = text.find("<PointData>"), end = text.find("</PointData>");
  text = text.substr(0, begin) + "<CellData><DataArray type=\"Float64\" Name=\"energy\" format=\"ascii\">" +
         std::string(2 * good.mesh.cell_types.size(), ' ')
             .replace(0, 0,
                      [&] {
                        std::string zeros;
                        for (std::size_t c = 0; c < good.mesh.cell_types.size(); ++c) zeros += "0 ";
                        return zeros;
                      }()) +
         "</DataArray></CellData>" + text.substr(end + 12);
  in.write("series_0.vtu", text);
  expect_refused({series, "--field", "enrgy"}, {"there are: none; and of cells: energy", "mean 'energy'"});
  expect_refused({series, "--field", "energy"},  // in the first frame only
                 {"series_1.vtu (frame 1)", "holds no such array", "there are: displacement"});
}

TEST_F(BadSeries, FramesOfDifferentMeshes) {
  good.write(in);
  SourceSeries other = good;
  other.add_point({100, 0, 0});
  for (auto& field : other.fields)
    for (auto& values : field.frames)
      values.resize(values.size() + static_cast<std::size_t>(field.components));
  in.write("series_3.vtu", other.vtu(3));
  expect_refused({in / "series.pvd", "--field", "displacement"},
                 {"series_3.vtu (frame 3)", "has " + std::to_string(good.mesh.points.size() + 1) + " nodes",
                  "frame 0 has " + std::to_string(good.mesh.points.size())});
  other = good;
  std::swap(other.mesh.connectivity[0], other.mesh.connectivity[1]);
  in.write("series_3.vtu", other.vtu(3));
  expect_refused({in / "series.pvd", "--field", "displacement"}, {"(frame 3)", "other cells than frame 0"});
}

TEST_F(BadSeries, ValuesThatAreNoNumbers) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const char* plane : {"0,1,0,0", "none"}) {
      SourceSeries series = good;
      series.fields[1].frames[2][6 * 17 + 4] = value;
      expect_refused({series.write(in), "--field", "displacement,stress:s", "--break", plane},
                     {"series_2.vtu (frame 2)", "field 'stress' is", "at node 17",
                      std::isnan(value) ? "not a number" : "infinite"});
    }
}

TEST_F(BadSeries, DamagedFiles) {
  const std::string series = good.write(in), sound = read_text_file(in / "series_1.vtu");
  const auto with = [&](const std::string& bytes) {
    in.write("series_1.vtu", bytes);
    expect_refused({series, "--field", "displacement"}, {"series_1.vtu"});
  };
  for (const double part : {0.0, 0.01, 0.3, 0.6, 0.9, 0.999})
    with(sound.substr(0, static_cast<std::size_t>(part * static_cast<double>(sound.size()))));
  with("<VTKFile type=\"PolyData\"><PolyData/></VTKFile>");
  with(std::string(5000, '\0'));
  std::string words = sound;  // fewer numbers than promised
  const auto at = words.find("format=\"ascii\">") + 15;
  words.erase(at, words.find('<', at) - at - 40);
  with(words);
  std::string type = sound;  // corners of nodes that do not exist
  const auto corners = type.find(">", type.find("Name=\"connectivity\"")) + 1;
  type.replace(corners, type.find(' ', corners) - corners, "999999");
  with(type);
  in.write("series_0.vtu", type);
  expect_refused({series, "--field", "displacement"}, {"series_0.vtu", "names node 999999 of"});
}

TEST_F(BadSeries, ListsThatAreNone) {
  good.write(in);
  const auto entry = [](const std::string& time, const std::string& file) {
    return "<DataSet timestep=\"" + time + "\" file=\"" + file + "\"/>";
  };
  const auto refused = [&](const std::string& entries, const std::vector<std::string>& parts) {
    std::vector<std::string> all = parts;
    all.push_back("list.pvd");
    expect_refused({pvd(entries), "--field", "displacement"}, all);
  };
  refused(entry("0", "series_0.vtu") + entry("1", "absent.vtu"),
          {"entry 2", "there is no file", "absent.vtu"});
  refused(entry("0", "series_0.vtu"), {"holds 1 frame", "needs 2"});
  refused("", {"holds 0 frames"});
  refused(entry("0", "series_0.vtu") + entry("2", "series_1.vtu") + entry("1", "series_2.vtu"),
          {"frame 2 at 1 follows one at 2", "sort"});
  refused(entry("1", "series_0.vtu") + entry("1", "series_1.vtu"), {"frame 1 at 1", "merged into one file"});
  refused(entry("0", "series_0.vtu") + entry("soon", "series_1.vtu"), {"entry 2, timestep", "'soon'"});
  refused(entry("0", "series_0.vtu") + entry("nan", "series_1.vtu"), {"list.pvd"});
  refused("<DataSet file=\"series_0.vtu\"/>", {"entry 1 lacks timestep"});
  refused(entry("0", "series.pvd"), {"is no .vtu file"});
  expect_refused({in.write("list.pvd", "no XML"), "--field", "a"}, {"list.pvd", "is no .pvd file"});
  expect_refused({in / "absent.pvd", "--field", "a"}, {"absent.pvd", "does it exist"});
  expect_refused({in / "series_0.vtu", "--field", "a"}, {"is one frame, and a series needs 2", ".pvd"});
  expect_refused({in.write("a.vtk", ""), "--field", "a"}, {"is one frame, and a series needs 2", ".series"});
  expect_refused({in.write("a.rst", ""), "--field", "a"},
                 {"unknown ending '.rst'", ".vtkhdf", "pvpython -c"});
  expect_refused({in.write("a.foam", ""), "--field", "a"}, {"foamToVTK", ".vtm.series"});
  expect_refused({in.write("a.vtkhdf", "nothing"), "--field", "a"}, {"a.vtkhdf", "is not an HDF5 file"});
  h5::File::create(in / "b.vtkhdf").close();
  expect_refused({in / "b.vtkhdf", "--field", "a"}, {"is no VTKHDF file"});
}

TEST_F(BadSeries, ListsInJsonThatAreNone) {
  good.write(in);
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    std::vector<std::string> all = parts;
    all.push_back("list.vtu.series");
    expect_refused({in.write("list.vtu.series", text), "--field", "displacement"}, all);
  };
  const std::string first = R"({"files": [{"name": "series_0.vtu", "time": 0}, )";
  refused("no JSON", {"is no list of files"});
  refused("[]", {"is no list of files"});
  refused(R"({"files": [{"name": "series_0.vtu"}]})", {"is no list of files"});
  refused(first + R"({"name": 3, "time": 1}]})", {"is no list of files"});
  refused(first + R"({"name": "absent.vtu", "time": 1}]})", {"entry 2", "absent.vtu"});
  refused(first + R"({"name": "a.png", "time": 1}]})", {"entry 2", "is no .vtu file"});
  expect_refused({in / "absent.vtk.series", "--field", "a"}, {"absent.vtk.series", "does it exist"});
}

TEST_F(BadSeries, SeveralThatDoNotBelongTogether) {
  const std::string first = good.write(in, "first");
  SourceSeries later = good;
  later.times.back() += 1;
  expect_refused({first, later.write(in, "later"), "--field", "first/displacement:d"},
                 {"later.pvd: frame 4 is at 9", "first.pvd at 8"});
  SourceSeries fewer = good;
  fewer.times.pop_back();
  expect_refused({first, fewer.write(in, "fewer"), "--field", "first/displacement:d"},
                 {"has 4 frames", "has 5"});
  SourceSeries moved = good;
  moved.mesh.points[3].x += 1;
  expect_refused({first, moved.write(in, "moved"), "--field", "first/displacement:d,moved/stress:s"},
                 {"moved_0.vtu (frame 0)", "has another mesh than", "first_0.vtu"});
  expect_refused({first, good.write(in, "same"), "--field", "displacement"},
                 {"holds no such array", "first/displacement"});
}

TEST_F(BadSeries, TensorsThatAreNotSymmetric) {
  SourceSeries series = good;
  SourceSeries::Field gradient{"gradient", 9, {}};
  for (std::size_t j = 0; j < series.times.size(); ++j)
    gradient.frames.emplace_back(9 * series.mesh.points.size(), 1.0);
  gradient.frames[2][9 * 11 + 3] = 1.5;
  series.fields.push_back(gradient);
  expect_refused({series.write(in), "--field", "displacement,gradient"},
                 {"series_2.vtu (frame 2)", "'gradient' is not symmetric at node 11", "three vectors"});
}

TEST_F(BadSeries, PlanesAndPolyhedra) {
  const std::string series = good.write(in);
  expect_refused({series, "--field", "displacement", "--break", "0,1,0,7"},
                 {"all nodes lie on one side", "0,1,0,7"});
  expect_refused({series, "--field", "displacement", "--break", "-1,0,0,16"}, {"all nodes lie on one side"});
  expect_refused({series, "--field", "displacement", "--break", "x"}, {"--break", "'x'"});
  expect_refused({series, "--field", "displacement", "--box", "round"}, {"--box", "round"});
  SourceSeries empty = good;
  empty.mesh.cell_types.clear(), empty.mesh.cell_offsets = {0}, empty.mesh.connectivity.clear();
  expect_refused(empty, {"series_0.vtu (frame 0)", "holds no cells"});

  SourceSeries cube;  // a polyhedron has faces besides corners
  for (int i = 0; i < 4; ++i) cube.add_point({1.0 * (i == 1), 1.0 * (i == 2), 1.0 * (i == 3)});
  cube.add_cell(42, {0, 1, 2, 3});
  cube.times = {0, 1};
  cube.fields = {{"displacement", 3, {std::vector<double>(12), std::vector<double>(12)}}};
  cube.write(in);
  for (std::size_t j = 0; j < 2; ++j) {
    std::string text = cube.vtu(j);
    text.insert(text.find("</Cells>"),
                "<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\">4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 "
                "3</DataArray>"
                "<DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">17</DataArray>");
    in.write("series_" + std::to_string(j) + ".vtu", text);
  }
  expect_refused({in / "series.pvd", "--field", "displacement"},
                 {"series_0.vtu (frame 0)", "cell 0 is a polyhedron", "tetrahedra"});
}

TEST_F(BadSeries, InputsAreNotOverwritten) {
  const std::string series = good.write(in);
  for (const char* name : {"series.pvd", "series_4.vtu"}) {
    const std::string before = read_text_file(in / name);
    expect_refused({series, "--field", "displacement", "--out", in / name}, {"is the input"});
    EXPECT_EQ(read_text_file(in / name), before);
  }
  expect_refused({series, "--field", "displacement", "--out", out / "absent/x.h5"}, {"does not exist"});
}

TEST_F(BadSeries, AFullDiskIsTold) {
  const Outcome outcome = on_a_full_disk(8, std::string(CLEFT_BIN) + "/cleft import " + good.write(in) +
                                                " --field displacement --out " + (out / "x.h5"));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("disk full"), std::string::npos) << outcome.output;
  EXPECT_EQ(out.entries(), 0);
}

}  // namespace cleft
