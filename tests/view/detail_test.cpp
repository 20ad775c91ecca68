// The level of detail in pixels, measured: what is drawn at rest, projected by the view's own camera.
#include <gtest/gtest.h>
#include <vtkCamera.h>

#include <cmath>

#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "explorer/view/offscreen_window.h"
#include "explorer/view/picture.h"
#include "explorer/view/stage.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

class PixelDetail : public SessionTest {
 protected:
  PixelDetail() {
    write_mesh(folder_ / "plate.stl", flat_plate(81, 61));
    drawn_.say("open " + study());
    drawn_.say("mesh " + folder_ / "plate.stl");
    drawn_.say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  }

  static std::pair<double, double> pixel(vtkRenderer* renderer, const Vec3& x) {
    renderer->SetWorldPoint(x.x, x.y, x.z, 1);
    renderer->WorldToDisplay();
    const double* at = renderer->GetDisplayPoint();
    return {at[0], at[1]};
  }

  struct Seen {
    int at_rest = 0;   // of those that are elsewhere without the level of detail
    double worst = 0;  // pixels by which one of these in the picture is off
  };
  /// In the view as it is drawn now, over all times. What is not drawn at rest must be where it always is.
  Seen look(Stage& stage, int i = 0, double samples = 1) {
    const auto whole = drawn_.scene_of(drawn_.views().at(i));
    const std::vector<Vec3>& rest = whole->surface().points;
    WoundView& view = stage.view(i);
    vtkRenderer* renderer = view.renderer();
    std::vector<bool> left(rest.size());
    std::vector<Vec3> x;
    Seen seen;
    for (int k = 0; k <= 50; ++k) {
      const double t = whole->duration() * k / 50;
      whole->positions(t, x);
      view.set_time(t);
      for (std::size_t v = 0; v < rest.size(); ++v) {
        if (view.points()[v] == x[v]) continue;
        EXPECT_EQ(view.points()[v], rest[v]);
        left[v] = true;
        const auto [a, b] = pixel(renderer, rest[v]);
        const auto [c, d] = pixel(renderer, x[v]);
        if (renderer->IsInViewport(static_cast<int>(a), static_cast<int>(b)))
          seen.worst = std::max(seen.worst, std::hypot(c - a, d - b) / samples);
      }
    }
    seen.at_rest = static_cast<int>(std::count(left.begin(), left.end(), true));
    return seen;
  }

  Session drawn_{session_services([](const std::string&) {})};
};

TEST_F(PixelDetail, HoldsWhereverTheCameraStands) {
  const auto window = make_offscreen_window(320, 240);
  Stage stage(window);
  stage.show(drawn_);
  EXPECT_EQ(look(stage).at_rest, 0) << "off at first";
  for (const double pixels : {0.1, 0.5, 3.}) {
    drawn_.say("detail " + shortest(pixels) + "px");
    double worst = 0;
    int before = 1 << 30;
    for (const char* camera :
         {"camera 0 0", "camera 0 0 2", "camera 50 20 5", "camera 0 0 20", "camera -80 0 3"}) {
      drawn_.say(camera);
      stage.show(drawn_);
      const Seen seen = look(stage);
      EXPECT_LE(seen.worst, pixels) << camera;
      worst = std::max(worst, seen.worst);
      EXPECT_LE(seen.worst, drawn_.seen() ? drawn_.seen()->pixels : 0) << "what it tells";
      if (std::string(camera) == "camera 0 0 20") {
        EXPECT_LT(seen.at_rest, before) << "they have come back";
      }
      before = std::min(before, seen.at_rest);
    }
    EXPECT_GT(worst, 0.4 * pixels)
        << "a factor of 1.4 for the steps, the others for what the bounds give away";
    drawn_.say("camera 0 0");
    stage.show(drawn_);
    EXPECT_GT(look(stage).at_rest, before);
  }
}

TEST_F(PixelDetail, HoldsWhereACameraComesNear) {
  const auto window = make_offscreen_window(320, 240);
  Stage stage(window);
  drawn_.say("detail 2px");
  drawn_.say("look 0,-20,150 0,0,0 0,1,0 30");
  stage.show(drawn_);
  const Seen far = look(stage);
  EXPECT_GT(far.at_rest, 0);
  drawn_.say("look 20,-60,25 0,0,0 0,0,1 60");  // along the skin: what is near moves by more pixels
  stage.show(drawn_);
  const Seen near = look(stage);
  EXPECT_LE(near.worst, 2);
  EXPECT_LT(near.at_rest, far.at_rest);
  drawn_.say("look 0,0,5 0,10,0 0,0,1 90");  // within what moves
  stage.show(drawn_);
  EXPECT_EQ(look(stage).at_rest, 0);
}

TEST_F(PixelDetail, FollowsWhoeverMovesTheCameraOrTheWindow) {
  const auto window = make_offscreen_window(320, 240);
  Stage stage(window);
  drawn_.say("detail 1px");
  stage.show(drawn_);
  window->Render();
  const int before = look(stage).at_rest;
  EXPECT_GT(before, 0);
  stage.view(0).renderer()->GetActiveCamera()->Dolly(3);
  window->Render();
  const Seen near = look(stage);
  EXPECT_LT(near.at_rest, before);
  EXPECT_LE(near.worst, 1);
  stage.view(0).renderer()->GetActiveCamera()->Dolly(1 / 3.);
  window->SetSize(1280, 960);
  window->Render();
  const Seen large = look(stage);
  EXPECT_LT(large.at_rest, before);
  EXPECT_LE(large.worst, 1);
}

TEST_F(PixelDetail, IsThatOfThePictureHoweverManySamplesItHasAndOfEveryView) {
  const auto window = make_offscreen_window(640, 480);
  Stage shot(window, 2);
  drawn_.say("detail 1px");
  shot.show(drawn_);
  const Seen seen = look(shot, 0, 2);
  EXPECT_LE(seen.worst, 1);
  EXPECT_GT(seen.worst, 0.4);
  drawn_.say("compare 1 4");
  shot.show(drawn_);
  for (const int i : {0, 1}) {
    const Seen one = look(shot, i, 2);
    EXPECT_LE(one.worst, 1);
    EXPECT_GT(one.at_rest, 0);
  }
  drawn_.say("detail off");
  shot.show(drawn_);
  EXPECT_EQ(look(shot).at_rest, 0);
  EXPECT_FALSE(drawn_.seen());
}

}  // namespace
}  // namespace cleft
