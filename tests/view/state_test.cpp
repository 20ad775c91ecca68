// Pictures of a session, without a window: the state in a picture gives the picture again.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include <cmath>

#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "explorer/view/offscreen_window.h"
#include "explorer/view/picture.h"
#include "explorer/view/stage.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

class Pictures : public SessionTest {
 protected:
  Pictures() { write_mesh(folder_ / "plate.stl", flat_plate()); }
  std::string bytes(const std::string& name) { return read_text_file(folder_ / name); }

  Session drawn_{session_services([](const std::string&) {})};
};

/// Lines that lead to different pictures.
class AnyView : public Pictures, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(
    Views, AnyView,
    testing::Values("time 12", "color strain", "color gape\nrange 0 2", "theme dark",
                    "compare 1 2 3 4\ntime 20", "compare 2 3", "difference 4", "camera 30 20 1.5",
                    "look 60,0,80 0,0,0 0,1,0 30", "mesh plate.stl\ncut -15,0.7,0,0,0,1 15,0.7,0,0,0,1",
                    "mesh plate.stl\ncut -15,0.7,0,0,0,1 15,0.7,0,0,0,1\ncut -5,9,0,0,0,1 5,9,0,0,0,1\ncolor "
                    "displacement",
                    "mesh plate.stl\ncut -15,0.7,0,0,0,1 15,0.7,0,0,0,1\ncompare 1 4\ncamera 20 30"));

TEST_P(AnyView, AStateGivesItsPictureAgainByteForByte) {
  drawn_.say("open " + study());
  drawn_.say("screenshot " + folder_ / "plain.png 240 160");
  std::istringstream lines(GetParam());
  for (std::string line; std::getline(lines, line);) {
    if (const std::size_t at = line.find("plate.stl"); at != std::string::npos)
      line.replace(at, 9, folder_ / "plate.stl");
    drawn_.say(line);
  }
  drawn_.say("screenshot " + folder_ / "a.png 240 160");
  EXPECT_NE(bytes("a.png"), bytes("plain.png"));
  Session again(session_services([](const std::string&) {}));
  again.say("load " + folder_ / "a.png");
  again.say("screenshot " + folder_ / "b.png 240 160");
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
}

TEST_F(Pictures, ATransparentOneHasTheSceneAndNothingBehindIt) {
  drawn_.say("open " + study());
  const auto read = [&](const std::string& how) {
    const std::string file = folder_ / "t.png";
    drawn_.say("screenshot " + file + " 240 160" + how);
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return vtkSmartPointer<vtkImageData>(reader->GetOutput());
  };
  const auto plain = read(""), clear = read(" transparent");
  ASSERT_EQ(plain->GetNumberOfScalarComponents(), 3);
  ASSERT_EQ(clear->GetNumberOfScalarComponents(), 4);
  const auto at = [](vtkImageData* image, int x, int y, int i) {
    return image->GetScalarComponentAsDouble(x, y, 0, i);
  };
  EXPECT_EQ(at(clear, 235, 155, 3), 0) << "the upper right corner is background";
  int same = 0, solid = 0;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 240; ++x) {
      if (at(clear, x, y, 3) < 255) continue;
      ++solid;
      double difference = 0;
      for (int i = 0; i < 3; ++i) difference += std::abs(at(clear, x, y, i) - at(plain, x, y, i));
      same += difference <= 6;
    }
  EXPECT_GT(solid, 240 * 160 / 10) << "the skin";
  EXPECT_LT(solid, 240 * 160 * 9 / 10);
  EXPECT_GT(same, 0.95 * solid) << "what is not clear is as in a picture with background";
}

TEST_F(Pictures, AStageThatWasElsewhereShowsTheSame) {
  // A window goes from view to view; a picture's stage begins with the last.
  const auto window = make_offscreen_window(64, 48);
  Stage stage(window);
  drawn_.say("open " + study());
  stage.show(drawn_);
  const std::vector<Vec3> narrow = stage.view(0).points();
  for (const char* line : {"compare 1 2 3 4", "case 4", "time 3", "single", "color strain", "theme dark"}) {
    drawn_.say(line);
    stage.show(drawn_);
    EXPECT_EQ(stage.views(), static_cast<int>(drawn_.views().size()));
    std::vector<Vec3> expected;
    drawn_.scene_of(drawn_.views().front())->positions(drawn_.state().time, expected);
    EXPECT_EQ(stage.view(0).points(), expected) << line;
  }
  EXPECT_NE(stage.view(0).points(), narrow);
  drawn_.say("close");
  stage.show(drawn_);
  EXPECT_EQ(stage.views(), 0);
}

TEST_F(Pictures, APictureOfAnotherProgramHoldsNoSession) {
  write_text_file(folder_ / "x.png", "no picture");
  try {
    drawn_.say("load " + folder_ / "x.png");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("x.png"), std::string::npos);
  }
}

TEST(Furniture, LengthsOfTheBarAreRound) {
  for (const auto& [most, round] : {std::pair{1., 1.},
                                    {1.9, 1.},
                                    {2., 2.},
                                    {4.99, 2.},
                                    {5., 5.},
                                    {9.9, 5.},
                                    {10., 10.},
                                    {0.3, 0.2},
                                    {0.07, 0.05},
                                    {730., 500.}})
    EXPECT_NEAR(round_length(most), round, 1e-12) << most;
}

}  // namespace
}  // namespace cleft
