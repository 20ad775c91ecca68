// A mesh's own colours in pictures: by the pixels.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include "explorer/scene/mesh_scene.h"
#include "explorer/view/picture.h"
#include "explorer/view/wound_view.h"
#include "tests/support/flat_plate.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

constexpr int across = 240, high = 160;

/// Green where x < 0, else blue, from one point to the next. Red is tissue, and the skin without colours.
std::shared_ptr<const CutSurface> painted(const Field& field) {
  SurfaceMesh plate = flat_plate();
  for (const Vec3& p : plate.points)
    plate.colors.push_back(p.x < 0 ? PointColor{0, 0.8F, 0} : PointColor{0, 0, 0.8F});
  const CanonicalCut& cut = field.cut();
  std::vector<ScalpelPath::Point> path;
  for (int i = 0; i <= 10; ++i)
    path.push_back({{cut.start + cut.length * i / 10 + 0.3, 0.7, 0}, {0, 0, 1}, cut.depth});
  return std::make_shared<CutSurface>(plate, std::vector{ScalpelPath(path)});
}

class OwnColors : public testing::Test {
 protected:
  struct Count {
    int green_left = 0, green_right = 0, blue_left = 0, blue_right = 0, red = 0;
  };
  Count count(double t, double margin = 60) {
    view_.set_time(t);
    write_picture(view_, across, high, folder_ / "own.png");
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder_ / "own.png").c_str());
    reader->Update();
    Count found;
    for (int y = 0; y < high; ++y)
      for (int x = 0; x < across; ++x) {
        double c[3];
        for (int k = 0; k < 3; ++k) c[k] = reader->GetOutput()->GetScalarComponentAsDouble(x, y, 0, k);
        const auto most = [&](int k) { return c[k] > margin + std::max(c[(k + 1) % 3], c[(k + 2) % 3]); };
        found.red += most(0);
        if (most(1)) ++(x < across / 2 ? found.green_left : found.green_right);
        if (most(2)) ++(x < across / 2 ? found.blue_left : found.blue_right);
      }
    return found;
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Field> field_ = std::make_shared<Field>(synthetic_field(5));
  WoundView view_;
};

TEST_F(OwnColors, AreWhereTheyAreInTheMeshAndWallsKeepThoseOfTissue) {
  view_.show(std::make_shared<MeshScene>(painted(*field_), CutFields(field_)));
  view_.color_by(Coloring::own);
  const Count closed = count(0), open = count(30);
  for (const Count& one : {closed, open}) {
    EXPECT_GT(one.green_left, 1500);
    EXPECT_GT(one.blue_right, 1500);
    EXPECT_LT(one.green_right + one.blue_left, 0.05 * (one.green_left + one.blue_right));
  }
  EXPECT_EQ(closed.red, 0);
  EXPECT_GT(open.red, 200) << "the wound";
  EXPECT_LT(open.green_left + open.blue_right, closed.green_left + closed.blue_right) << "where it was skin";
  view_.color_by(Coloring::tissue);
  const Count tissue = count(30);
  EXPECT_EQ(tissue.green_left + tissue.blue_right, 0);
  view_.color_by(Coloring::own);
  EXPECT_EQ(count(30).green_left, open.green_left) << "and back";
}

TEST_F(OwnColors, OfAGuessArePale) {
  view_.show(std::make_shared<MeshScene>(painted(*field_), CutFields(field_)));
  view_.color_by(Coloring::own);
  const Count sure = count(30, 100);
  view_.set_faded(true);
  EXPECT_GT(sure.green_left, 1500);
  EXPECT_LT(count(30, 100).green_left, sure.green_left / 10) << "0.35 of its own, and grey";
  view_.set_faded(false);
  EXPECT_EQ(count(30, 100).green_left, sure.green_left);
}

TEST_F(OwnColors, OfAMeshWithoutThemAreThoseOfSkin) {
  const auto plain = std::make_shared<CutSurface>(flat_plate(), std::vector<ScalpelPath>{});
  view_.show(std::make_shared<MeshScene>(plain, CutFields(field_)));
  view_.color_by(Coloring::own);
  const Count own = count(0);
  EXPECT_EQ(own.green_left + own.blue_right, 0);
}

}  // namespace
}  // namespace cleft
