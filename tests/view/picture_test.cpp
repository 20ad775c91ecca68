// What a picture shows, by its pixels.
#include "explorer/view/picture.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "explorer/scene/patch_scene.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

constexpr int width = 240, height = 160;

class Picture : public testing::Test {
 protected:
  Picture() {
    view_.color_by(Coloring::displacement);
    view_.show(std::make_shared<PatchScene>(shared_));
  }
  ~Picture() override { std::filesystem::remove(file()); }

  static std::string file() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    return testing::TempDir() + "cleft_picture_" + test->name() + ".png";
  }

  vtkSmartPointer<vtkImageData> draw(double t) {
    view_.set_time(t);
    write_picture(view_, width, height, file());
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file().c_str());
    reader->Update();
    return reader->GetOutput();
  }

  using Rgb = std::array<int, 3>;
  static Rgb pixel(vtkImageData* image, int x, int y) {
    Rgb rgb;
    for (int i = 0; i < 3; ++i) rgb[i] = static_cast<int>(image->GetScalarComponentAsDouble(x, y, 0, i));
    return rgb;
  }
  static int difference(const Rgb& a, const Rgb& b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  }

  std::shared_ptr<const Field> shared_ = std::make_shared<Field>(synthetic_field(5));
  const Field& field_ = *shared_;
  WoundView view_;
};

TEST_F(Picture, HasTheSizeAskedForAndIsNotEmpty) {
  const auto image = draw(0);
  EXPECT_EQ(image->GetDimensions()[0], width);
  EXPECT_EQ(image->GetDimensions()[1], height);
  std::set<Rgb> colors;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) colors.insert(pixel(image, x, y));
  EXPECT_GT(colors.size(), 20u);
  EXPECT_GT(difference(pixel(image, width / 2, height / 2), pixel(image, 2, 2)), 30)
      << "patch against background";
}

TEST_F(Picture, TheOpenWoundDiffersFromTheClosedOneWhereItIs) {
  const auto closed = draw(0), open = draw(field_.duration());
  EXPECT_GT(difference(pixel(open, width / 2, height / 2), pixel(closed, width / 2, height / 2)), 60);
  for (const auto& [x, y] : {std::pair{2, 2}, {width - 3, 2}, {2, height - 3}})
    EXPECT_EQ(difference(pixel(open, x, y), pixel(closed, x, y)), 0) << x << ' ' << y;
}

TEST_F(Picture, TheBottomOfTheWoundIsRed) {
  const Rgb bottom = pixel(draw(field_.duration()), width / 2, height / 2);
  EXPECT_GT(bottom[0], 2 * bottom[1]);
  EXPECT_GT(bottom[0], 2 * bottom[2]);
}

TEST_F(Picture, TheCutToComeIsNotSeen) {
  // Along the row of the cut, the picture before the cut is as even as the skin next to it.
  const auto closed = draw(0);
  for (int x = width / 2 - 20; x <= width / 2 + 20; ++x)
    EXPECT_LE(difference(pixel(closed, x, height / 2), pixel(closed, x, height / 2 + 6)), 6) << x;
}

TEST_F(Picture, TheSameTimeGivesTheSamePicture) {
  const auto first = draw(15);
  draw(30);
  const auto again = draw(15);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_EQ(pixel(first, x, y), pixel(again, x, y));
}

TEST_F(Picture, NeedsNoDisplay) {
  const char* display = std::getenv("DISPLAY");
  const std::string before = display ? display : "";
  unsetenv("DISPLAY");
  const auto image = draw(field_.duration());
  if (display) setenv("DISPLAY", before.c_str(), 1);
  EXPECT_GT(difference(pixel(image, width / 2, height / 2), pixel(image, 2, 2)), 60);
}

TEST_F(Picture, AnAbsentFolderOrAnotherFormatIsTheUsersError) {
  EXPECT_THROW(write_picture(view_, width, height, testing::TempDir() + "a.jpg"), InputError);
  EXPECT_THROW(write_picture(view_, width, height, "/nonexistent/folder/a.png"), InputError);
}

}  // namespace
}  // namespace cleft
