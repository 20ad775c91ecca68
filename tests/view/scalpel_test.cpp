// The scalpel in the picture: its shape, and where its edge and its shade are.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <map>

#include "explorer/scene/patch_scene.h"
#include "explorer/view/picture.h"
#include "explorer/view/scalpel_shape.h"
#include "explorer/view/scalpel_view.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

struct Solid {
  double volume = 0;
  int loose = 0;  // edges that are not of two faces, one in each direction
};

Solid solid_of(vtkPolyData* data) {
  Solid solid;
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  vtkIdType size;
  const vtkIdType* t;
  vtkCellArray* faces = data->GetPolys();
  for (faces->InitTraversal(); faces->GetNextCell(size, t);) {
    Vec3 p[3];
    for (int i = 0; i < 3; ++i) data->GetPoint(t[i], &p[i].x), ++edges[{t[i], t[(i + 1) % 3]}];
    solid.volume += dot(p[0], cross(p[1], p[2])) / 6;
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    solid.loose += count != 1 || back == edges.end();
  }
  return solid;
}

/// How thick it is at a height, along its edge or its back, within `reach` mm.
double thickness(vtkPolyData* blade, double z, bool edge) {
  double outmost = edge ? -HUGE_VAL : HUGE_VAL, thick = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (vtkIdType i = 0; i < blade->GetNumberOfPoints(); ++i) {
      double p[3];
      blade->GetPoint(i, p);
      if (std::abs(p[2] - z) > 0.3) continue;
      if (pass == 0) outmost = edge ? std::max(outmost, p[0]) : std::min(outmost, p[0]);
      if (pass == 1 && std::abs(p[0] - outmost) < 0.2) thick = std::max(thick, 2 * std::abs(p[1]));
    }
  return thick;
}

TEST(ScalpelShape, IsTwoSolidsWithItsTipAtTheOriginAndTheEdgeAhead) {
  const auto blade = scalpel_blade(), handle = scalpel_handle();
  for (vtkPolyData* part : {blade.Get(), handle.Get()}) {
    const Solid solid = solid_of(part);
    EXPECT_EQ(solid.loose, 0) << "closed";
    EXPECT_GT(solid.volume, 0) << "its faces look outwards";
  }
  const double* box = blade->GetBounds();
  EXPECT_NEAR(box[4], 0, 1e-9) << "nothing is below the tip";
  EXPECT_NEAR(box[5], 30, 1e-9);
  EXPECT_NEAR(handle->GetBounds()[5], 140, 1e-9);
  for (const double z : {5., 10., 18.}) {
    EXPECT_LT(thickness(blade, z, true), 0.02) << "sharp " << z;
    EXPECT_NEAR(thickness(blade, z, false), 0.4, 1e-6) << "and with a back " << z;
  }
}

class ScalpelInPicture : public testing::Test {
 protected:
  vtkSmartPointer<vtkImageData> draw() {
    write_picture(view_, 240, 160, folder_ / "scalpel.png");
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder_ / "scalpel.png").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  /// Of the pixels that two pictures differ in, how many, their mean column, and whether they are darker.
  struct Difference {
    int count = 0, darker = 0;
    double column = 0;
  };
  static Difference difference(vtkImageData* a, vtkImageData* b) {
    Difference d;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 240; ++x) {
        double more = 0;
        for (int k = 0; k < 3; ++k)
          more += a->GetScalarComponentAsDouble(x, y, 0, k) - b->GetScalarComponentAsDouble(x, y, 0, k);
        if (std::abs(more) < 3) continue;
        ++d.count, d.column += x, d.darker += more < 0;
      }
    d.column /= std::max(d.count, 1);
    return d;
  }
  ScalpelInPicture() {
    view_.show(std::make_shared<PatchScene>(std::make_shared<Field>(synthetic_field(5))));
    view_.color_by(Coloring::tissue);
    view_.set_lifelike(true);
    view_.set_time(0);
  }

  TemporaryFolder folder_;
  WoundView view_;
};

TEST_F(ScalpelInPicture, TheEdgeIsWhereItCuts) {
  CameraState above;  // the picture's right is x; the handle is towards the eye
  above.elevation = -60;
  view_.aim(above);
  const auto without = draw();
  double column[2];
  for (const bool right : {false, true}) {
    ScalpelView scalpel(view_.renderer());
    ScalpelPose pose;
    pose.axis = {0, 0.2, 1};
    pose.edge = {right ? 1. : -1., 0, 0};
    scalpel.move(pose, {0, 0, 0});
    const Difference seen = difference(draw(), without);
    EXPECT_GT(seen.count, 200);
    column[right] = seen.column;
    pose.present = false;
    scalpel.move(pose, {0, 0, 0});
    EXPECT_EQ(difference(draw(), without).count, 0) << "a device that is gone has none";
  }
  EXPECT_GT(column[1], column[0] + 1) << "more of the blade is on the side of its edge";
  EXPECT_EQ(difference(draw(), without).count, 0) << "and it is taken away";
}

TEST_F(ScalpelInPicture, ItsShadeIsBesideIt) {
  const auto without = draw();
  ScalpelPose pose;
  pose.tip = {12, 8, 0};
  pose.axis = normalized(Vec3{1, 0, 0.5});
  view_.shade_under(&pose);
  const Difference shade = difference(draw(), without);
  EXPECT_GT(shade.count, 100);
  EXPECT_EQ(shade.darker, shade.count);
  EXPECT_GT(shade.column, 120 + 10) << "the scalpel is right of the middle";
  view_.shade_under(nullptr);
  EXPECT_EQ(difference(draw(), without).count, 0);
}

}  // namespace
}  // namespace cleft
