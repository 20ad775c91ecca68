// What cleft encode tells of imported series: errors of every field, and warnings where a spline is far off.
#include <gtest/gtest.h>

#include <algorithm>

#include "encoder/field/file/field_file.h"
#include "encoder/samples.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class EncodeReport : public testing::Test {
 protected:
  /// Figures of cleft encode, and warnings among its output.
  Outcome encode(const SourceSeries& series, const std::string& fields,
                 const std::vector<std::string>& options = {}) {
    expect_success(
        run_cleft("import", {series.write(folder), "--field", fields, "--out", folder / "case.h5"}));
    std::vector<std::string> arguments = {folder / "case.h5", "--out", folder / "case.dffd", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return expect_success(run_cleft("encode", arguments));
  }

  const TemporaryFolder folder;
};

/// The plate, with a layer that is hotter by 100 K than all others, and moved before the first frame by the
/// square of the distance.
SourceSeries hot_and_moved(const Plate& plate) {
  SourceSeries series = plate.series();
  series.fields.push_back({"hot", 1, {}});
  for (std::size_t j = 0; j < Plate::frames; ++j) {
    std::vector<double> hot;
    for (std::size_t n = 0; n < plate.local.size(); ++n) {
      const Vec3& p = plate.local[n];
      hot.push_back(std::abs(p.x - 4) < 0.1 ? 400 : 300);
      series.fields[0].frames[j][3 * n + 2] += 0.05 * p.x * p.x;
    }
    series.fields.back().frames.push_back(hot);
  }
  return series;
}

}  // namespace

TEST_F(EncodeReport, EveryFieldsSplineErrorIsToldAndWarnedOf) {
  const Plate plate(Plate::Cells::hexahedra, Pose());
  const Outcome outcome = encode(hot_and_moved(plate), "displacement,hot:heat[K],temperature");
  const nlohmann::json figures = figures_of(outcome);
  const Field field = read_field(folder / "case.dffd");
  const SnapshotReader reader(folder / "case.h5");
  const Snapshot& s = reader.snapshot();
  const std::vector<Sample> samples = samples_of(s);
  const std::vector<Vec3> closed = reader.displacement(0);
  ASSERT_EQ(field.quantities.size(), 3u);
  for (std::size_t q = 0; q < 3; ++q) {
    const Quantity& quantity = field.quantities[q];
    double worst = 0, at_worst = 0;
    for (std::size_t j = 0; j < s.frames(); ++j)
      for (std::size_t n = 0; n < samples.size(); ++n) {
        std::vector<double> found(static_cast<std::size_t>(quantity.components)),
            data = {closed[n].x, closed[n].y, closed[n].z};
        if (quantity.components == 1) data = {reader.point_array({quantity.name, 1, true}, j)[n]};
        field.quantity(q, samples[n].uvw, samples[n].side, s.times[j], found);
        double off = 0;
        for (std::size_t c = 0; c < found.size(); ++c) off = std::hypot(off, found[c] - data[c]);
        worst = std::max(worst, off);
        if (static_cast<double>(n) == quantity.worst_node && s.times[j] == quantity.worst_time)
          at_worst = off;
      }
    worst /= quantity.scale;
    EXPECT_NEAR(quantity.spline_error, worst, 1e-9) << quantity.name;
    EXPECT_NEAR(at_worst, worst * quantity.scale, 1e-9 * quantity.scale) << quantity.name;
    EXPECT_NEAR(figures["quantities"][q]["spline_error"].get<double>(), worst, 1e-9);
    const bool far_off = worst > 0.02;
    EXPECT_EQ(far_off, quantity.name != "temperature") << worst;
    const std::string warning = "warning: " + quantity.name;
    EXPECT_EQ(outcome.output.find(warning) != std::string::npos, far_off) << outcome.output;
    const auto is_of = [&](const nlohmann::json& text) {
      return text.get<std::string>().starts_with(quantity.name);
    };
    EXPECT_EQ(std::any_of(figures["warnings"].begin(), figures["warnings"].end(), is_of), far_off);
  }
  for (const char* told : {"(the displacement of frame 0): the spline", "at node ",
                           "and t = ", "--tolerance displacement=0.1%", "import heat without it"})
    EXPECT_NE(outcome.output.find(told), std::string::npos) << told << "\n" << outcome.output;
}

}  // namespace cleft
