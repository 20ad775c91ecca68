// Where nodes beside a curved cut are seen from: against all feet of normals, found along the cut step by
// step.
#include "encoder/curved_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "params/meshed_cut.h"

namespace cleft {
namespace {

/// The cut and the lines that continue it, in the plane, in small steps from -60 to 60 mm.
class Curve {
 public:
  explicit Curve(const Parameters& p) {
    const double half = meshed_cut(p).length / 2;
    for (const int way : {-1, 1}) {
      Vec3 at;
      double direction = 0;
      for (int i = 0; i < steps; ++i) {
        const double s = way * i * step;
        points_[way > 0 ? steps + i : steps - i] = {s, at, direction};
        const double middle = s + way * step / 2;
        const double turn =
            std::abs(middle) < half ? way * (p.cut.curvature + p.cut.curvature_rate * middle) * step : 0;
        at += way * step * Vec3{std::cos(direction + turn / 2), std::sin(direction + turn / 2), 0};
        direction += turn;
      }
    }
    points_[0] = points_[1];
  }

  /// All (u, v) from which a place is seen at a right angle, the nearest first.
  std::vector<Vec3> feet(const Vec3& place) const {
    std::vector<Vec3> list;
    const auto seen = [&](const Point& p) {
      const Vec3 off = place - p.at;
      const double c = std::cos(p.direction), s = std::sin(p.direction);
      return Vec3{c * off.x + s * off.y, c * off.y - s * off.x, p.s};
    };
    for (int i = 1; i + 1 < 2 * steps; ++i) {
      const Vec3 a = seen(points_[i]), b = seen(points_[i + 1]);
      if (a.x * b.x > 0 || a.x == b.x) continue;
      const double part = a.x / (a.x - b.x);
      list.push_back({a.z + part * step, a.y + part * (b.y - a.y), 0});
    }
    std::sort(list.begin(), list.end(),
              [](const Vec3& a, const Vec3& b) { return std::abs(a.y) < std::abs(b.y); });
    return list;
  }

 private:
  static constexpr int steps = 12000;
  static constexpr double step = 0.005;
  struct Point {
    double s;
    Vec3 at;
    double direction;
  };
  std::vector<Point> points_{2 * steps};
};

TEST(FurtherPlaces, AreAllFeetOfNormalsOnTheSideOfTheNearest) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> along(-30, 30), across(-45, 45);
  for (const auto& [curvature, rate] :
       {std::pair{1. / 15, 0.}, {-1. / 22, 0.}, {0., 0.005}, {0.02, -0.004}}) {
    Parameters p;
    p.cut.curvature = curvature, p.cut.curvature_rate = rate;
    const Curve curve(p);
    const CutCurve cut(p);
    int several = 0;
    for (int k = 0; k < 300; ++k) {
      const std::vector<Vec3> feet = curve.feet({along(random), across(random), 0});
      if (feet.empty()) continue;  // behind both ends
      const Vec3 nearest{feet.front().x, feet.front().y, -1};
      std::vector<Vec3> places = further_places(cut, nearest);
      std::erase_if(places, [](const Vec3& place) { return std::abs(place.x) > 59; });
      std::vector<Vec3> should(feet.begin() + 1, feet.end());
      std::erase_if(should, [&](const Vec3& foot) { return foot.y * nearest.y < 0; });
      ASSERT_EQ(places.size(), should.size()) << nearest.x << ", " << nearest.y;
      std::sort(places.begin(), places.end(),
                [](const Vec3& a, const Vec3& b) { return std::abs(a.y) < std::abs(b.y); });
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(places[i].x, should[i].x, 0.05);  // where normals nearly meet, that is ill-conditioned
        EXPECT_NEAR(places[i].y, should[i].y, 0.02);
        EXPECT_EQ(places[i].z, -1);
      }
      several += !places.empty();
    }
    EXPECT_GT(several, 20);
  }
}

TEST(FurtherPlaces, AreNoneOfStraightCutsAndOnTheOuterSide) {
  Parameters p;
  EXPECT_TRUE(further_places(CutCurve(p), {0, 20, 0}).empty());
  p.cut.curvature = 0.05;
  EXPECT_TRUE(further_places(CutCurve(p), {0, -20, 0}).empty());
  EXPECT_TRUE(further_places(CutCurve(p), {0, 0, 0}).empty());
}

}  // namespace
}  // namespace cleft
