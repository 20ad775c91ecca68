// The light of skin and wounds: the sky that places see, against closed forms and sampled rays, and pixels.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <random>

#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/view/open_sky.h"
#include "explorer/view/picture.h"
#include "tests/support/flat_plate.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

/// A sphere, or its lower half, of radius 50; seen from outside, or from inside.
SurfaceMesh sphere(bool half, bool inside) {
  constexpr int around = 48, rows = 24;
  SurfaceMesh mesh;
  const auto at = [&](int i, int j) {
    const double polar = M_PI * (half ? 0.5 + 0.5 * i / rows : double(i) / rows),
                 angle = 2 * M_PI * j / around;
    return 50 * Vec3{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
  };
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < around; ++j) mesh.points.push_back(at(i, j));
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      const int a = i * around + j, b = i * around + (j + 1) % around, c = a + around, d = b + around;
      for (std::array<int, 3> t : {std::array{a, c, d}, std::array{a, d, b}}) {
        if (inside) std::swap(t[1], t[2]);
        mesh.triangles.push_back(t);
      }
    }
  return mesh;
}

TEST(OpenSky, AConvexBodySeesAllOfIt) {
  const SurfaceMesh ball = sphere(false, false);
  for (const float open : open_sky(ball.points, ball.triangles)) EXPECT_GT(open, 0.97);
}

/// From every place inside a sphere each part of it is seen with the same weight, its share of the sphere's
/// area: through the mouth of a half sphere, where the other half was, half of the light comes.
TEST(OpenSky, InAHalfSphereItIsHalf) {
  const SurfaceMesh bowl = sphere(true, true);
  const std::vector<float> open = open_sky(bowl.points, bowl.triangles);
  double sum = 0;
  int count = 0;
  for (std::size_t p = 0; p < open.size(); ++p) {
    if (bowl.points[p].z > -8) continue;  // at the rim single directions graze
    // Of as many random directions, with cosines as weights, one deviation: even ones must do better.
    EXPECT_NEAR(open[p], 0.5, 0.5 * std::sqrt(4. / 3 / (sky_directions / 2.))) << p;
    sum += open[p], ++count;
  }
  EXPECT_NEAR(sum / count, 0.5, 0.02);
}

class WoundLight : public testing::Test {
 protected:
  static std::shared_ptr<const CutSurface> cut_plate(const Field& field) {
    const CanonicalCut& cut = field.cut();
    std::vector<ScalpelPath::Point> path;
    for (int i = 0; i <= 10; ++i)
      path.push_back({{cut.start + cut.length * i / 10 + 0.3, 0.7, 0}, {0, 0, 1}, cut.depth});
    return std::make_shared<CutSurface>(flat_plate(), std::vector{ScalpelPath(path)});
  }
  vtkSmartPointer<vtkImageData> draw() {
    write_picture(view_, 240, 160, folder_ / "light.png");
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder_ / "light.png").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  static std::array<double, 3> pixel(vtkImageData* image, int x, int y) {
    std::array<double, 3> rgb{};
    for (int k = 0; k < 3; ++k) rgb[k] = image->GetScalarComponentAsDouble(x, y, 0, k);
    return rgb;
  }
  static int different(vtkImageData* a, vtkImageData* b) {
    int count = 0;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 240; ++x) count += pixel(a, x, y) != pixel(b, x, y);
    return count;
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Field> field_ = std::make_shared<Field>(synthetic_field(5));
  WoundView view_;
};

/// Rays from a wall 3 mm below the lip of a slot of 4 mm, cosines as their weights.
TEST_F(WoundLight, AWallSeesThroughItsSlotWhatRaysSee) {
  const MeshScene scene(cut_plate(*field_), CutFields(field_));
  const WoundSurface& surface = scene.surface();
  const SurfaceLight light(surface);
  std::vector<Vec3> apart = surface.points;  // two walls that stay parallel
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int p : surface.triangles[t])
      if (surface.regions[t] != Region::skin)
        apart[p].y = surface.points[p].y + (surface.regions[t] == Region::left_wall ? 2 : -2);
  std::vector<SurfaceLight::Light> lights;
  light.at(apart, lights);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(0, 1);
  const auto rays = [&](double depth, double width) {
    int out = 0, up = 0;
    for (int i = 0; i < 200000; ++i) {  // by cosines to y, the wall's normal
      const double radius = std::sqrt(even(random)), angle = 2 * M_PI * even(random),
                   z = radius * std::sin(angle), y = std::sqrt(1 - radius * radius);
      up += z > 0;
      out += z > 0 && z * width / y > depth;
    }
    return double(out) / up;
  };
  int compared = 0;
  for (std::size_t p = 0; p < apart.size(); ++p) {
    const double depth = -surface.points[p].z;
    if (depth < 0.5 || depth > 5 || std::abs(surface.points[p].x) > 8 || compared > 40) continue;
    EXPECT_NEAR(lights[p].open, rays(depth, 4), 0.01) << depth << ": three deviations of the rays";
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST_F(WoundLight, LipsAreWetWhereTheyAreApart) {
  const MeshScene scene(cut_plate(*field_), CutFields(field_));
  const SurfaceLight light(scene.surface());
  std::vector<SurfaceLight::Light> lights;
  std::vector<Vec3> points;
  for (const double t : {0., 15., 30.}) {
    scene.positions(t, points);
    light.at(points, lights);
    int wet = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Vec3& x = scene.surface().points[v];
      const bool skin = scene.surface().depth_fraction[v] == 0;
      if (!skin) continue;
      wet += lights[v].dry < 0.1F;
      if (lights[v].dry < 0.1F) {
        EXPECT_NEAR(x.y, 0.7, 1e-6) << "on the cut";
        EXPECT_LE(x.x, -14.7 + t + 1.5) << "behind the tip, to an interval of the field's knots";
      }
    }
    EXPECT_EQ(wet > 10, t > 0) << t;
  }
}

TEST_F(WoundLight, ACutKeepsTheSkyOfTheMesh) {
  const auto plain = std::make_shared<CutSurface>(flat_plate(), std::vector<ScalpelPath>{});
  const MeshScene before(plain, CutFields(field_)), after(cut_plate(*field_), CutFields(field_));
  const SurfaceLight known(before.surface()), taken(after.surface(), &known);
  std::vector<SurfaceLight::Light> first, second;
  known.at(before.surface().points, first);
  taken.at(after.surface().points, second);
  for (int p = 0; p < after.surface().original_points; ++p) EXPECT_EQ(second[p].open, first[p].open);
  for (std::size_t p = after.surface().original_points; p < second.size(); ++p)
    EXPECT_TRUE(second[p].open >= 0 && second[p].open <= 1) << p;
}

TEST_F(WoundLight, ColoursOfValuesStayAsTheyAre) {
  view_.show(std::make_shared<PatchScene>(field_));
  view_.color_by(Coloring::displacement);
  view_.set_time(0);  // the wound is closed: only skin is seen
  const auto plain = draw();
  view_.set_lifelike(true);
  EXPECT_EQ(different(draw(), plain), 0);
  view_.color_by(Coloring::tissue);
  const auto skin = draw();
  view_.set_lifelike(false);
  EXPECT_GT(different(draw(), skin), 5000);
  view_.set_lifelike(true), view_.set_edges(true);
  const auto lined = draw();
  view_.set_lifelike(false);
  EXPECT_EQ(different(draw(), lined), 0) << "edges are in plain light";
}

TEST_F(WoundLight, TheWoundIsRedDarkerBelowAndShines) {
  view_.show(std::make_shared<PatchScene>(field_));
  view_.color_by(Coloring::tissue);
  view_.set_lifelike(true);
  const auto open = draw();
  const auto bottom = pixel(open, 120, 80), skin = pixel(open, 120, 125);
  EXPECT_GT(bottom[0], 1.5 * bottom[2]);
  EXPECT_LT(bottom[0], skin[0]);
  EXPECT_GT(skin[0], skin[1]);
  EXPECT_GT(skin[1], skin[2]);
}

}  // namespace
}  // namespace cleft
