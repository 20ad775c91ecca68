// How surfaces are drawn: colour maps, ranges, warp, clipping and edges, against other ways to find them.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>

#include "explorer/scene/patch_scene.h"
#include "explorer/view/picture.h"
#include "explorer/view/wound_colors.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

using Lab = std::array<double, 3>;

/// CIELAB of sRGB with the white D65, from the definitions.
Lab lab_of(const double rgb[3]) {
  double linear[3];
  for (int i = 0; i < 3; ++i)
    linear[i] = rgb[i] <= 0.04045 ? rgb[i] / 12.92 : std::pow((rgb[i] + 0.055) / 1.055, 2.4);
  const double xyz[] = {(0.4124 * linear[0] + 0.3576 * linear[1] + 0.1805 * linear[2]) / 0.95047,
                        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2],
                        (0.0193 * linear[0] + 0.1192 * linear[1] + 0.9505 * linear[2]) / 1.08883};
  double f[3];
  for (int i = 0; i < 3; ++i)
    f[i] = xyz[i] > 216. / 24389 ? std::cbrt(xyz[i]) : (24389. / 27 * xyz[i] + 16) / 116;
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

std::vector<Lab> colors_of(const ColorMap& map, int count) {
  const auto table = value_colors(map, -1, 1);
  std::vector<Lab> colors;
  for (int i = 0; i < count; ++i) {
    double rgb[3];
    table->GetColor(-1 + 2. * i / (count - 1), rgb);
    colors.push_back(lab_of(rgb));
  }
  return colors;
}

TEST(ColorMaps, LightnessGoesOneWayAndStepsAreAlike) {
  for (const ColorMap& map : color_maps()) {
    if (map.diverging) continue;
    const std::vector<Lab> colors = colors_of(map, 17);
    const double way = colors.back()[0] > colors.front()[0] ? 1 : -1;
    double least = HUGE_VAL, most = 0;
    for (std::size_t i = 1; i < colors.size(); ++i) {
      EXPECT_GT(way * (colors[i][0] - colors[i - 1][0]), 0) << map.name << " " << i;
      const double step = std::hypot(colors[i][0] - colors[i - 1][0], colors[i][1] - colors[i - 1][1],
                                     colors[i][2] - colors[i - 1][2]);
      least = std::min(least, step), most = std::max(most, step);
    }
    EXPECT_LT(most, 4 * least) << map.name << ": the same difference of values is as well seen everywhere";
    EXPECT_GT(std::abs(colors.back()[0] - colors.front()[0]), 55) << map.name << ": also without colour";
  }
}

TEST(ColorMaps, ADivergingOneIsLightInTheMiddleAndAsDarkOnBothSides) {
  const ColorMap& map = color_maps().back();
  ASSERT_TRUE(map.diverging);
  const std::vector<Lab> colors = colors_of(map, 17);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT(colors[i][0], colors[i + 1][0]);
    EXPECT_LT(colors[16 - i][0], colors[15 - i][0]);
    EXPECT_LT(std::abs(colors[i][0] - colors[16 - i][0]), 12) << i;
  }
  EXPECT_LT(std::hypot(colors[8][1], colors[8][2]), 8) << "neutral";
  EXPECT_LT(colors[0][2], -10) << "blue";
  EXPECT_GT(colors[16][1], 10) << "brown";
}

class Look : public testing::Test {
 protected:
  Look() { view_.show(std::make_shared<PatchScene>(shared_)); }
  vtkSmartPointer<vtkImageData> draw() {
    write_picture(view_, 240, 160, folder_ / "look.png");
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder_ / "look.png").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  static double shade(vtkImageData* image, int x, int y) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += image->GetScalarComponentAsDouble(x, y, 0, k);
    return sum;
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Field> shared_ = std::make_shared<Field>(synthetic_field(5));
  WoundView view_;
};

TEST_F(Look, WarpMultipliesDisplacementsOnly) {
  view_.set_time(30);
  const std::vector<Vec3> once = view_.points();
  const PatchScene scene(shared_);
  view_.set_warp(3);
  for (std::size_t i = 0; i < once.size(); ++i) {
    const Vec3& rest = scene.surface().points[i];
    EXPECT_LT(norm(view_.points()[i] - (rest + 3 * (once[i] - rest))), 1e-12);
  }
  view_.set_warp(1);
  EXPECT_EQ(view_.points(), once);
}

TEST_F(Look, PercentilesAreThoseOfAllValuesAtAllTimes) {
  const PatchScene scene(shared_);
  std::vector<double> all, values;
  for (int i = 1; i <= 8; ++i) {
    scene.values(Coloring::displacement, nullptr, 30. * i / 8, values);
    all.insert(all.end(), values.begin(), values.end());
  }
  const auto [least, greatest] = view_.range_of(Coloring::displacement, nullptr, std::pair{20., 90.});
  const auto below = [&](double value) {
    return 100. * double(std::count_if(all.begin(), all.end(), [&](double v) { return v < value; })) /
           double(all.size());
  };
  EXPECT_NEAR(below(greatest), 90, 0.1);
  EXPECT_LE(below(least), 20.1);
  EXPECT_LT(greatest, view_.range_of(Coloring::displacement, nullptr).second);
}

TEST_F(Look, WideningIsTheDifferenceOfGapesWithItsSign) {
  const Field narrow = synthetic_field(3);
  const VaryingField wide_field(*shared_), narrow_field(narrow);
  const Place lip{{0, 1e-9, 0}, Side::right, 30};
  const double more = color_value(Coloring::widening, wide_field, &narrow, lip),
               less = color_value(Coloring::widening, narrow_field, shared_.get(), lip);
  const auto opening = [](const Field& field) {
    return norm(field.displacement({0, 0, 0}, Side::right, 30) -
                field.displacement({0, 0, 0}, Side::left, 30));
  };
  EXPECT_NEAR(more, opening(*shared_) - opening(narrow), 1e-6);
  EXPECT_NEAR(less, -more, 1e-12);
  const auto [low, high] = view_.range_of(Coloring::widening, &narrow);
  EXPECT_EQ(low, -high) << "0 is in the middle of the colours";
  EXPECT_GT(high, 1);
}

TEST_F(Look, WhatLiesBeyondAPlaneIsNotDrawn) {
  const auto whole = draw();
  view_.set_clip(ClipState{{0, 0, 0}, {1, 0, 0}});
  const auto clipped = draw();
  const int y = 110;  // beside the wound; the background is even along a row
  const double background = shade(whole, 3, y);
  ASSERT_GT(std::abs(shade(whole, 150, y) - background), 60) << "the skin is seen against it";
  EXPECT_LT(std::abs(shade(clipped, 150, y) - background), 6);
  EXPECT_EQ(shade(clipped, 90, y), shade(whole, 90, y));
  view_.set_clip({});
  EXPECT_EQ(shade(draw(), 150, y), shade(whole, 150, y));
}

TEST_F(Look, EdgesAreLinesOverTheSkin) {
  const auto spread = [](vtkImageData* image) {  // of neighbours, far from the wound
    double sum = 0;
    for (int x = 80; x < 160; ++x) sum += std::abs(shade(image, x + 1, 115) - shade(image, x, 115));
    return sum;
  };
  const double without = spread(draw());
  view_.set_edges(true);
  EXPECT_GT(spread(draw()), 4 * without + 100);
}

}  // namespace
}  // namespace cleft
