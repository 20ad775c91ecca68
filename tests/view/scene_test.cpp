// The surfaces that are drawn: closed at t = 0, open as the field predicts, and the same whichever way time
// runs.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <map>
#include <set>

#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/view/wound_view.h"
#include "tests/support/flat_plate.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

/// A flat skin of 60 x 40 mm with a straight path through its middle, as long as the field's cut.
std::shared_ptr<const CutSurface> cut_plate(const Field& field, const SurfaceMesh& plate = flat_plate()) {
  const CanonicalCut& cut = field.cut();
  std::vector<ScalpelPath::Point> path;
  for (int i = 0; i <= 10; ++i)
    path.push_back({{cut.start + cut.length * i / 10 + 0.3, 0.7, 0}, {0, 0, 1}, cut.depth});
  return std::make_shared<CutSurface>(plate, std::vector{ScalpelPath(path)});
}

/// Both kinds of scenes, from one field.
class AnyScene : public testing::TestWithParam<const char*> {
 protected:
  AnyScene() {
    if (std::string(GetParam()) == "patch") {
      scene_ = std::make_shared<PatchScene>(shared_);
    } else {
      scene_ = std::make_shared<MeshScene>(cut_plate(*shared_), CutFields(shared_));
    }
  }

  std::vector<Vec3> at(double t) const {
    std::vector<Vec3> points;
    scene_->positions(t, points);
    return points;
  }

  /// Points at the same place at rest: the two lips, and the two walls.
  std::vector<std::pair<int, int>> pairs() const {
    std::map<std::array<double, 3>, int> first;
    std::vector<std::pair<int, int>> found;
    const std::vector<Vec3>& x = scene_->surface().points;
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      const auto [other, fresh] = first.try_emplace({x[i].x, x[i].y, x[i].z}, i);
      if (!fresh) found.emplace_back(other->second, i);
    }
    return found;
  }

  std::shared_ptr<const Field> shared_ = std::make_shared<Field>(synthetic_field(5));
  const Field& field_ = *shared_;
  std::shared_ptr<WoundScene> scene_;
};
INSTANTIATE_TEST_SUITE_P(Scenes, AnyScene, testing::Values("patch", "mesh"));

TEST_P(AnyScene, IsAtRestBeforeTheCut) {
  const std::vector<Vec3> points = at(0);
  ASSERT_EQ(points.size(), scene_->surface().points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i], scene_->surface().points[i]);
}

TEST_P(AnyScene, IsExactlyClosedAheadOfTheTipAndOpenBehindIt) {
  for (const double t : {5., 12., 20.}) {
    const std::vector<Vec3> points = at(t);
    int closed = 0, open = 0;
    double widest = 0;
    for (const auto& [a, b] : pairs()) {
      const double gap = norm(points[a] - points[b]);
      if (scene_->surface().points[a].x > field_.cut().start + 0.3 + t) {
        EXPECT_EQ(points[a], points[b]);
        ++closed;
      } else {
        open += gap > 0;
      }
      widest = std::max(widest, gap);
    }
    EXPECT_GT(closed, 10);
    EXPECT_GT(open, 10);
    EXPECT_GT(widest, 5 * 0.5 * std::min(t / 10, 1.)) << "half of the gape that the field was made with";
    EXPECT_LT(widest, 5.01) << "more than the field's largest control points";
  }
}

TEST_P(AnyScene, DoesNotRememberWhereTheBladeWas) {
  WoundView view;
  view.show(scene_);
  view.set_time(7);
  const std::vector<Vec3> before = view.points();
  view.set_time(25);
  EXPECT_NE(view.points(), before);
  view.set_time(7);
  EXPECT_EQ(view.points(), before);
}

TEST_P(AnyScene, TimeIsClampedToTheCut) {
  WoundView view;
  view.show(scene_);
  EXPECT_EQ(view.time(), scene_->duration());
  view.set_time(1e9);
  EXPECT_EQ(view.time(), scene_->duration());
  view.set_time(-1);
  EXPECT_EQ(view.time(), 0);
}

TEST_P(AnyScene, SkinAndWallsAreOneOrientedSurface) {
  const WoundSurface& surface = scene_->surface();
  std::set<std::pair<int, int>> edges;
  for (const auto& t : surface.triangles)
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second) << "an edge is used twice";
  double left = -1e300, right = 1e300;  // the rim of the patch or plate is the only place without a neighbour
  for (const Vec3& x : surface.points) left = std::max(left, x.x), right = std::min(right, x.x);
  for (const auto& [a, b] : edges) {
    if (edges.count({b, a})) continue;
    for (int v : {a, b}) {
      const Vec3& x = surface.points[v];
      EXPECT_TRUE(x.x == left || x.x == right || std::abs(std::abs(x.y) - 20) < 1e-9)
          << x.x << ' ' << x.y << ' ' << x.z;
    }
  }
}

TEST_P(AnyScene, WallsFaceTheGap) {
  const WoundSurface& surface = scene_->surface();
  const std::vector<Vec3> points = at(scene_->duration());
  Vec3 left, right, skin;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 area = cross(points[b] - points[a], points[c] - points[a]);
    (surface.regions[t] == Region::skin        ? skin
     : surface.regions[t] == Region::left_wall ? left
                                               : right) += area;
  }
  EXPECT_GT(skin.z, 0);
  EXPECT_GT(left.y, 0);
  EXPECT_LT(right.y, 0);
}

TEST_P(AnyScene, TheLipIsCrisp) {
  const WoundSurface& surface = scene_->surface();
  SurfacePart skin(surface, [](Region r) { return r == Region::skin; });
  SurfacePart walls(surface, [](Region r) { return r == Region::left_wall; });
  const std::vector<Vec3> points = at(scene_->duration());
  skin.move(points), walls.move(points);
  // No skin normal leans into the wound and no wall normal up to the skin, though they meet at the lip.
  const auto least_z = [](const SurfacePart& part, double sign) {
    auto* normals = part.data()->GetPointData()->GetNormals();
    double least = 1;
    for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
      least = std::min(least, sign * normals->GetComponent(i, 2));
    return least;
  };
  EXPECT_GT(least_z(skin, 1), 0.99) << "the field moves the skin in its plane only";
  EXPECT_GT(least_z(walls, -1), -0.75) << "walls rise steeply: 6 mm over at most 2.5";
}

TEST_P(AnyScene, ClosedLipsShareTheirNormal) {
  // Skin that falls away on both sides of the closed cut: each lip alone would lean to its own side.
  SurfacePart skin(scene_->surface(), [](Region r) { return r == Region::skin; });
  std::vector<Vec3> points = scene_->surface().points;
  const double middle = scene_->surface().middle.y;
  for (Vec3& x : points) x.z -= 0.5 * std::abs(x.y - middle);
  skin.move(points);
  auto* normals = skin.data()->GetPointData()->GetNormals();
  std::map<std::array<double, 3>, std::array<double, 3>> at;
  int pairs_found = 0;
  for (vtkIdType i = 0; i < skin.data()->GetNumberOfPoints(); ++i) {
    std::array<double, 3> place, normal;
    skin.data()->GetPoint(i, place.data());
    normals->GetTuple(i, normal.data());
    const auto [other, fresh] = at.try_emplace(place, normal);
    if (fresh) continue;
    EXPECT_EQ(other->second, normal);
    ++pairs_found;
  }
  EXPECT_GT(pairs_found, 10);
}

TEST(SurfacePart, DrawsWhatNeverMovesApartAndAlike) {
  const auto field = std::make_shared<Field>(synthetic_field(5));
  const MeshScene scene(cut_plate(*field, flat_plate(81, 61)), CutFields(field));
  const WoundSurface& surface = scene.surface();
  const auto is_skin = [](Region r) { return r == Region::skin; };
  SurfacePart whole(surface, is_skin), parted(surface, is_skin, scene.moving());
  const vtkIdType still = parted.still()->GetNumberOfCells(), moving = parted.data()->GetNumberOfCells();
  EXPECT_EQ(still + moving, whole.data()->GetNumberOfCells());
  EXPECT_GT(still, moving / 10);
  const vtkMTimeType before = parted.still()->GetMTime();
  for (const double t : {3., scene.duration()}) {
    std::vector<Vec3> points;
    scene.positions(t, points);
    for (std::size_t i = 0; i < points.size(); ++i)  // not in its plane only, so that normals turn
      points[i].z += 3 * (points[i] - surface.points[i]).y;
    whole.move(points), parted.move(points);
    std::map<std::array<double, 3>, std::set<std::array<double, 3>>> normals;
    const auto each = [](vtkPolyData* data, const auto& use) {
      std::array<double, 3> place, normal;
      for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        data->GetPoint(i, place.data());
        data->GetPointData()->GetNormals()->GetTuple(i, normal.data());
        use(place, normal);
      }
    };
    double steepest = 0;
    each(whole.data(), [&](const auto& place, const auto& normal) {
      normals[place].insert(normal), steepest = std::max(steepest, 1 - normal[2]);
    });
    EXPECT_GT(steepest, 0.01);
    for (vtkPolyData* part : {parted.still(), parted.data()})
      each(part, [&](const auto& place, const auto& normal) {
        EXPECT_TRUE(normals[place].contains(normal)) << place[0] << ' ' << place[1] << ' ' << normal[2];
      });
  }
  EXPECT_EQ(parted.still()->GetMTime(), before) << "nothing of it is sent to be drawn again";
}

}  // namespace
}  // namespace cleft
