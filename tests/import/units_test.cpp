// Units of imported fields: in tolerances, and in the series that come back.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class Units : public testing::Test {
 protected:
  void SetUp() override {
    expect_success(
        run_cleft("import", {plate.series().write(folder), "--field", "displacement:displacement[mm]",
                             "--field", "stress:stress[N/mm^2],temperature:T[K]", "--out", snapshot}));
  }
  void encode() { expect_success(run_cleft("encode", {snapshot, "--out", dffd})); }
  /// Exit code 2, and all of this told.
  void expect_refused(const std::string& command, const std::vector<std::string>& arguments,
                      const std::vector<std::string>& told) {
    const Outcome outcome = run_cleft(command, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& text : told)
      EXPECT_NE(outcome.output.find(text), std::string::npos) << text << "\n" << outcome.output;
  }

  const Plate plate{Plate::Cells::hexahedra, Pose::random(4)};
  const TemporaryFolder folder;
  const std::string snapshot = folder / "case.h5", dffd = folder / "case.dffd";
};

/// What VTK's readers take as the unit of an array of a .vtu file: the text in its element.
std::string unit_in(const std::string& vtu, const std::string& array) {
  const std::string text = read_text_file(vtu);
  const std::size_t begin = text.find("Name=\"" + array + "\""), end = text.find("</DataArray>", begin),
                    key = text.find("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">", begin);
  if (begin == text.npos || key == text.npos || key > end) return "";
  const std::size_t value = text.find_first_not_of(" \n", text.find('>', key) + 1);
  return text.substr(value, text.find_first_of(" \n<", value) - value);
}

}  // namespace

TEST_F(Units, AreInDecodedAndExportedSeries) {
  encode();
  expect_success(run_cleft("decode", {dffd, "--on", folder / "series_0.vtu", "--out", folder / "on.pvd"}));
  expect_success(run_cleft("export", {dffd, "--paraview", folder / "drawn.pvd", "--frames", "2"}));
  expect_success(run_cleft("export", {snapshot, "--paraview", folder / "data.pvd"}));
  for (const std::string series : {"on", "drawn", "data"}) {
    const std::string vtu = folder / (series + "/frame_0001.vtu");
    const std::string temperature = series == "on" ? "temperature" : "T";  // the source's name, and ours
    EXPECT_EQ(unit_in(vtu, "displacement"), "mm") << series;
    EXPECT_EQ(unit_in(vtu, "stress"), "N/mm^2") << series;
    EXPECT_EQ(unit_in(vtu, temperature), "K") << series;
  }
  expect_success(run_cleft("decode", {dffd, "--nodes", snapshot, "--out", folder / "on.vtkhdf"}));
  const h5::File file = h5::File::open(folder / "on.vtkhdf");
  for (const auto& [array, unit] :
       {std::pair("displacement", "mm"), {"stress", "N/mm^2"}, {"temperature", "K"}})
    EXPECT_EQ(file.read_text(std::string("/VTKHDF/PointData/") + array, "UNITS_LABEL"), unit);
}

TEST_F(Units, AnExportWithoutTheSnapshotTellsWhatItLeavesOut) {
  encode();
  const std::string alone = folder / "alone.dffd";
  std::filesystem::copy_file(dffd, alone);
  const Outcome outcome =
      expect_success(run_cleft("export", {alone, "--paraview", folder / "alone.pvd", "--frames", "2"}));
  EXPECT_NE(outcome.output.find("left out without the snapshot: T, stress;"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("--nodes"), std::string::npos) << outcome.output;
  const Outcome with = expect_success(
      run_cleft("export", {alone, "--nodes", snapshot, "--paraview", folder / "with.pvd", "--frames", "2"}));
  EXPECT_EQ(with.output.find("left out"), std::string::npos) << with.output;
}

TEST_F(Units, OfATolerancesAreTheFieldsOwn) {
  const auto with = [&](const std::string& tolerance) {
    return std::vector<std::string>{snapshot, "--out", folder / "none.dffd", "--tolerance", tolerance};
  };
  expect_refused("encode", with("T=0.5MPa"), {"--tolerance T: is in K, not in MPa"});
  expect_refused("encode", with("stress=5kPa"), {"--tolerance stress: is in N/mm^2, not in kPa"});
  expect_refused("encode", with("0.01m"), {"--tolerance displacement: is in mm, not in m"});
  expect_refused("encode", with("abc"), {"--tolerance: 'abc' is not a number"});
  expect_refused("encode", with("T=K"), {"--tolerance T: 'K' is not a number"});
  EXPECT_FALSE(std::filesystem::exists(folder / "none.dffd"));
  expect_success(run_cleft("encode", with("0.01,T=0.5K,stress=0.02N/mm^2")));
}

TEST_F(Units, BracketsWithoutAUnitAreRefused) {
  expect_refused("import", {folder / "series.pvd", "--field", "temperature:T[]", "--out", folder / "none.h5"},
                 {"'temperature:T[]'", "hold no unit"});
}

/// A lip's v is often 0 but for rounding.
TEST_F(Units, TheSideThatIsGivenDecidesOnTheBreak) {
  encode();
  const auto at = [&](const std::string& v, int side) {
    write_text_file(folder / "points.csv",
                    "u,v,w,side,t\n-4," + v + ",-0.5," + std::to_string(side) + ",5\n");
    return run_cleft("eval", {dffd, "--points", folder / "points.csv"});
  };
  for (const int side : {-1, 1}) {
    const std::string exact = expect_success(at("0", side)).output;
    for (const char* v : {"7e-16", "-7e-16"})
      EXPECT_EQ(expect_success(at(v, side)).output, exact) << v << side;
  }
  EXPECT_NE(at("0", -1).output, at("0", 1).output);
  EXPECT_EQ(at("0.1", -1).exit_code, 2);
}

}  // namespace cleft
