// Fields whose components are arrays of their own, and vectors of two components.
#include <gtest/gtest.h>

#include <algorithm>

#include "encoder/import/frame_files.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class Components : public testing::Test {
 protected:
  const Plate plate{Plate::Cells::hexahedra, Pose::random(4)};
  const SourceSeries whole = plate.series();  // displacement, stress, temperature
  const TemporaryFolder folder;

  /// The components of a field of the series, as fields.
  std::vector<SourceSeries::Field> apart(std::size_t field, const std::vector<std::string>& names) const {
    std::vector<SourceSeries::Field> all;
    const SourceSeries::Field& of = whole.fields[field];
    for (std::size_t c = 0; c < names.size(); ++c) {
      all.push_back({names[c], 1, {}});
      for (const std::vector<double>& values : of.frames) {
        std::vector<double>& one = all.back().frames.emplace_back();
        for (std::size_t i = c; i < values.size(); i += static_cast<std::size_t>(of.components))
          one.push_back(values[i]);
      }
    }
    return all;
  }
  SourceSeries with(const std::vector<std::vector<SourceSeries::Field>>& fields) const {
    SourceSeries series = whole;
    series.fields.clear();
    for (const auto& some : fields) series.fields.insert(series.fields.end(), some.begin(), some.end());
    return series;
  }
  void import(const SourceSeries& series, const std::string& fields, const std::string& name) const {
    expect_success(run_cleft("import", {series.write(folder, name), "--field", fields, "--out", h5(name)}));
  }
  std::string h5(const std::string& name) const { return folder / (name + ".h5"); }

  void expect_as_whole(const std::string& name) const {
    import(whole, "displacement,stress", "whole");
    const SnapshotReader expected(h5("whole")), found(h5(name));
    const SnapshotArray stress = expected.point_arrays().at(0);
    for (std::size_t j = 0; j < Plate::frames; ++j) {
      EXPECT_EQ(largest_difference(expected.displacement(j), found.displacement(j)), 0);
      EXPECT_EQ(expected.point_array(stress, j), found.point_array(stress, j));
    }
  }
};

const std::vector<std::string> six{"s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_zx"};

}  // namespace

TEST_F(Components, AreFoundByTheirEndings) {
  import(with({apart(0, {"disp_x", "disp_y", "disp_z"}), apart(1, six)}), "disp:displacement,s:stress",
         "apart");
  expect_as_whole("apart");
}

TEST_F(Components, AreThoseThatAreTold) {
  import(with({apart(0, {"a", "b", "c"}), apart(1, {"S11", "S22", "S33", "S12", "S23", "S13"})}),
         "a+b+c:displacement,S11+S12+S13+S12+S22+S23+S13+S23+S33:stress", "told");
  expect_as_whole("told");
}

TEST_F(Components, ComeBackAsArraysOfTheirOwn) {
  const SourceSeries series = with({apart(0, {"ux", "uy", "uz"}), apart(1, six), {whole.fields[2]}});
  import(series, "u:displacement,s:stress,temperature", "apart");
  expect_success(run_cleft("encode", {h5("apart"), "--tolerance", "0.1", "--out", folder / "apart.dffd"}));
  expect_success(
      run_cleft("decode", {folder / "apart.dffd", "--nodes", h5("apart"), "--out", folder / "back.pvd"}));
  const auto back = open_series({folder / "back.pvd"});
  std::vector<std::string> names = back->point_arrays(0), expected{"ux", "uy", "uz", "temperature"};
  expected.insert(expected.end(), six.begin(), six.end());
  std::sort(names.begin(), names.end()), std::sort(expected.begin(), expected.end());
  ASSERT_EQ(names, expected);
  for (const SourceSeries::Field& field : series.fields) {
    const SourceArray array = back->read(4, {{field.name}, {}}).arrays.at(0);
    ASSERT_EQ(array.values.size(), field.frames[4].size());
    for (std::size_t i = 0; i < array.values.size(); ++i)
      ASSERT_NEAR(array.values[i], field.frames[4][i], field.name[0] == 'u' ? 0.2 : 30) << field.name;
  }
}

TEST_F(Components, AnArrayWhoseNameIsASumComesBackAsOne) {
  SourceSeries series = with({{whole.fields[0]}, {whole.fields[0]}, {whole.fields[2]}});
  series.fields[1].name = "a+b", series.fields[2].name = "c++d+";
  import(series, "displacement,a+b:flow,c++d+:warmth", "sum");
  expect_success(run_cleft("encode", {h5("sum"), "--tolerance", "0.1", "--out", folder / "sum.dffd"}));
  expect_success(
      run_cleft("decode", {folder / "sum.dffd", "--nodes", h5("sum"), "--out", folder / "back.pvd"}));
  std::vector<std::string> names = open_series({folder / "back.pvd"})->point_arrays(0);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"a+b", "c++d+", "displacement"}));
}

TEST_F(Components, TwoAreAVectorInThePlane) {
  SourceSeries::Field flow{"flow", 2, {}};
  for (std::size_t j = 0; j < Plate::frames; ++j) flow.frames.emplace_back(2 * whole.mesh.points.size(), 3.);
  SourceSeries series = with({{whole.fields[0], flow}});
  series.write(folder, "plane");
  const ImportedSeries imported(folder / "plane.pvd", parse_fields({"flow"}));
  EXPECT_EQ(imported.fields()[0].components, 3);
  const std::vector<double> values = imported.frame(0)[0];
  EXPECT_EQ((std::vector<double>{values[0], values[1], values[2]}), (std::vector<double>{3, 3, 0}));
}

TEST_F(Components, OneThatIsMissingIsNamed) {
  with({apart(0, {"a", "b", "c"})}).write(folder, "less");
  const auto refused = [&](const std::string& field, const std::string& told) {
    const Outcome outcome =
        run_cleft("import", {folder / "less.pvd", "--field", field, "--out", folder / "no.h5"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(told), std::string::npos) << outcome.output;
  };
  refused("a+b+d:displacement", "holds no array 'd'");
  refused("0+0:displacement", "holds no such array");
}

}  // namespace cleft
