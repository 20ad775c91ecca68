// The interactive window, by its state.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "encoder/field/field_file.h"
#include "explorer/view/explore_window.h"
#include "explorer/view/offscreen_window.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

class Window : public testing::Test {
 protected:
  Window() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("cleft_window_") + test->name());
    for (const double gape : {2., 5.}) {
      const fs::path folder = folder_ / "cases" / std::to_string(gape);
      fs::create_directories(folder);
      Field field = synthetic_field(gape);
      field.parameters["skin.prestress_v"] = gape / 100;
      write_field((folder / "case.dffd").string(), field);
      write_text_file((folder / "manifest.json").string(), "{}");
    }
    explorer_.emplace(ExplorerInput{folder_.string(), "", "", 1});
  }
  ~Window() override {
    explorer_.reset();
    fs::remove_all(folder_);
  }

  static void drag(vtkSliderWidget* slider, double value) {
    static_cast<vtkSliderRepresentation*>(slider->GetRepresentation())->SetValue(value);
    slider->InvokeEvent(vtkCommand::InteractionEvent);
  }

  fs::path folder_;
  std::optional<Explorer> explorer_;
};

TEST_F(Window, WithoutADisplayNamesTheRemedy) {
  const char* display = std::getenv("DISPLAY");
  const std::string before = display ? display : "";
  unsetenv("DISPLAY");
  try {
    ExploreWindow window(*explorer_, 320, 240);
    ADD_FAILURE() << "a window was opened without a display";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("--screenshot"), std::string::npos);
  }
  if (display) setenv("DISPLAY", before.c_str(), 1);
}

TEST_F(Window, TheCaseChangesAndTheTimeStays) {
  explorer_->view().set_time(12);
  const std::vector<Vec3> narrow = explorer_->view().points();
  explorer_->show_case(1);
  EXPECT_EQ(explorer_->view().time(), 12);
  EXPECT_NE(explorer_->view().points(), narrow);
  explorer_->show_case(0);
  EXPECT_EQ(explorer_->view().points(), narrow);
}

TEST_F(Window, SlidersMoveTimeAndCase) {
  if (!has_display()) GTEST_SKIP() << "no X display; the test runs under xvfb-run as view_test_with_x";
  ExploreWindow window(*explorer_, 320, 240);
  drag(window.time_slider(), 9);
  EXPECT_EQ(explorer_->view().time(), 9);
  drag(window.case_slider(), 1.7);
  EXPECT_EQ(explorer_->shown_case(), 1);
  EXPECT_EQ(explorer_->view().time(), 9);
  for (vtkSliderWidget* slider : {window.time_slider(), window.case_slider()})
    EXPECT_TRUE(explorer_->view().renderer()->HasViewProp(slider->GetRepresentation())) << "a slider vanished";
  drag(window.time_slider(), 4);
  const std::vector<Vec3> points = explorer_->view().points();
  drag(window.time_slider(), 20);
  drag(window.time_slider(), 4);
  EXPECT_EQ(explorer_->view().points(), points);
}

}  // namespace
}  // namespace cleft
