// The surface's answers against brute force, while it is whole and while it changes.
#include <gtest/gtest.h>

#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

using testing::ball;
using testing::Surface;

Vec3 random_place(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> along(-reach, reach);
  return {along(random), along(random), along(random)};
}

/// Segments of all lengths and points at all distances; `surface` must be what the reader reads.
void compare_with_brute_force(const Surface& s, ContactReader& reader, int queries, unsigned seed) {
  std::mt19937 random(seed);
  int met = 0, missed = 0;
  const ContactLook look(reader);
  for (int n = 0; n < queries; ++n) {
    const Vec3 from = random_place(random, 14),
               to = n % 3 ? from + 0.1 * random_place(random, 14) : random_place(random, 14);
    for (const Facing facing : {Facing::front, Facing::back, Facing::any}) {
      const auto expected = testing::brute_first_contact(s, from, to, facing);
      if (expected.margin < 1e-9) continue;  // through an edge, to rounding: either answer is right
      const SurfaceHit hit = reader.first_contact(from, to, facing);
      ASSERT_EQ(bool(hit), expected.fraction <= 1) << n;
      hit ? ++met : ++missed;
      if (!hit) continue;
      ASSERT_NEAR(hit.fraction, expected.fraction, 1e-9) << n;
      ASSERT_LE(norm(hit.position - lerp(from, to, expected.fraction)), 1e-8);
    }
    const double radius = n % 5 ? 1.5 : 20, distance = testing::brute_distance(s, from);
    const NearestPoint nearest = reader.nearest(from, radius);
    ASSERT_EQ(bool(nearest), distance <= radius) << n << ' ' << distance;
    if (nearest) {
      ASSERT_NEAR(std::abs(nearest.distance), distance, 1e-12) << n;
    }
  }
  EXPECT_GT(met, queries / 4);
  EXPECT_GT(missed, queries / 4);
}

TEST(Contact, AgreesWithBruteForce) {
  const Surface s = ball(16, 10, 0.1);
  for (const double cell : {0., 0.3, 7.}) {
    const ContactSurface surface(s.points, s.triangles, {cell});
    ContactReader reader(surface);
    compare_with_brute_force(s, reader, 1000, 1);
  }
}

TEST(Contact, NearestPointTellsTheSide) {
  // Of a convex ball a point is inside where it is nearer to the middle than every face's plane.
  const Surface s = ball(10, 10);
  const ContactSurface surface(s.points, s.triangles);
  ContactReader reader(surface);
  const ContactLook look(reader);
  std::mt19937 random(3);
  for (int n = 0; n < 3000; ++n) {
    Vec3 x = random_place(random, 11);
    if (n % 4 == 0)
      x = (n % 8 ? 1.01 : 0.99) * s.points[random() % s.points.size()];  // over and under vertices
    bool inside = true;
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
      inside = inside && dot(x - s.points[s.triangles[t][0]], scaled_normal(testing::corners(s, t))) < 0;
    const NearestPoint p = reader.nearest(x, 30);
    ASSERT_TRUE(p);
    ASSERT_EQ(p.distance < 0, inside) << n;
  }
}

TEST(Contact, NothingSlipsThroughSeams) {
  // Segments aimed at vertices and at points of edges, to the last bit.
  const Surface s = ball(12, 10, 0.05);
  const ContactSurface surface(s.points, s.triangles);
  ContactReader reader(surface);
  const ContactLook look(reader);
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i)
      for (const double part : {0., 0.25, 0.5, 1 / 3.}) {
        const Vec3 target = lerp(s.points[t[i]], s.points[t[(i + 1) % 3]], part);
        ASSERT_TRUE(reader.first_contact(1.3 * target, 0.7 * target, Facing::front));
        ASSERT_TRUE(reader.first_contact(0.7 * target, 1.3 * target, Facing::back));
      }
}

TEST(Contact, ShortWaysAreMetFarFromTheOrigin) {
  // 0.2 micrometres through the middle of every triangle, metres away: less than numbers of 24 bits can tell.
  Surface s = ball(12, 10, 0.05);
  for (Vec3& p : s.points) p += Vec3{5000, -3000, 2000};
  const ContactSurface surface(s.points, s.triangles);
  ContactReader reader(surface);
  const ContactLook look(reader);
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const Corners c = testing::corners(s, t);
    const Vec3 middle = 1 / 3. * (c[0] + c[1] + c[2]), out = 1e-4 * normalized(scaled_normal(c));
    ASSERT_EQ(reader.first_contact(middle + out, middle - out, Facing::front).triangle, static_cast<int>(t));
    ASSERT_NEAR(reader.nearest(middle + out, 1).distance, 1e-4, 1e-9);
  }
}

TEST(Contact, FollowsEveryChange) {
  // Vertices move, triangles are divided, go and come, twenty steps one after the other.
  Surface s = ball(12, 10, 0.1);
  ContactSurface surface(s.points, s.triangles);
  ContactReader reader(surface);
  std::mt19937 random(7);
  for (int step = 0; step < 20; ++step) {
    std::vector<ContactSurface::Moved> moved;
    std::vector<ContactSurface::Changed> changed;
    for (int n = 0; n < 15; ++n) {
      const auto v = random() % s.points.size();
      s.points[v] = s.points[v] + 0.1 * random_place(random, 6);
      moved.push_back({static_cast<int>(v), s.points[v]});
    }
    for (int n = 0; n < 10; ++n) {  // one triangle becomes three
      const auto t = random() % s.triangles.size();
      const Corners c = testing::corners(s, t);
      const int m = static_cast<int>(s.points.size());
      s.points.push_back(1 / 3. * (c[0] + c[1] + c[2]) + 0.1 * random_place(random, 3));
      moved.push_back({m, s.points.back()});
      const auto [a, b, d] = s.triangles[t];
      s.triangles[t] = {a, b, m};
      changed.push_back({static_cast<int>(t), {{a, b, m}}});
      for (const auto& corner : {std::array{b, d, m}, std::array{d, a, m}}) {
        changed.push_back({static_cast<int>(s.triangles.size()), {corner}});
        s.triangles.push_back(corner);
      }
    }
    if (step % 2) {  // the last ones go
      for (int n = 0; n < 3; ++n) {
        s.triangles.pop_back();
        changed.push_back({static_cast<int>(s.triangles.size()), {}});
      }
    }
    surface.update(moved, changed);
    compare_with_brute_force(s, reader, 60, static_cast<unsigned>(step));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(Contact, AReaderKeepsItsStep) {
  // What began before a step sees nothing of it, and what begins after it sees all of it.
  const Surface s = testing::flat(8, 1);
  ContactSurface surface(s.points, s.triangles);
  ContactReader before(surface), after(surface);
  before.begin();
  std::vector<ContactSurface::Moved> down;
  for (std::size_t v = 0; v < s.points.size(); ++v)
    down.push_back({static_cast<int>(v), s.points[v] - Vec3{0, 0, 1.5}});
  surface.update(down, {});
  after.begin();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-3.9, 3.9);
  for (int n = 0; n < 500; ++n) {
    const Vec3 above{along(random), along(random), 1}, below = above - Vec3{0, 0, 3};
    EXPECT_NEAR(before.first_contact(above, below, Facing::front).position.z, 0, 1e-12);
    EXPECT_NEAR(after.first_contact(above, below, Facing::front).position.z, -1.5, 1e-12);
  }
  before.end(), after.end();
}

TEST(Contact, ReadersAreCounted) {
  const Surface s = testing::flat(2, 1);
  const ContactSurface surface(s.points, s.triangles);
  { const ContactReader a(surface), b(surface), c(surface), d(surface); }
  const ContactReader a(surface), b(surface), c(surface), d(surface);
  EXPECT_THROW(ContactReader{surface}, InputError);
}

}  // namespace
}  // namespace cleft
