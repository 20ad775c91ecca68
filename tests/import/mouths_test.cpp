// Cracks that begin within the body's outline: at notches, corners and holes, with whole material beside or
// behind what is not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/import/cracked_bodies.h"
#include "tests/import/field_errors.h"

namespace cleft {

namespace {

/// A crack along b = 0 from a = 6 on, where the body begins above it. Faces in its plane are on its sides.
CrackedBody from_six(const std::string& name, bool flat) {
  CrackedBody body = edge_crack();
  body.name = name + (flat ? ", 2D" : "");
  if (flat) body.c = {0};
  body.times = planes(0, 9, 9);
  body.doubled = [](const Vec3& x) { return 6 <= x.x && x.x < 24; };
  body.side = [](const Vec3& x, const Vec3& middle) {
    return x.y != 0 || x.x >= 24 ? 0 : middle.y < 0 ? -1 : 1;
  };
  body.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 6 - 2 * t, x.y, side);
  };
  return body;
}

/// The notch is above the plane of the crack.
CrackedBody one_sided_notch(bool flat) {
  CrackedBody body = from_six("one-sided notch", flat);
  body.solid = [](const Vec3& x) { return x.x > 6 || x.y < 0 || x.y > 2; };
  return body;
}

/// The crack goes on where one face of the corner ends.
CrackedBody corner(bool flat) {
  CrackedBody body = from_six("re-entrant corner", flat);
  body.solid = [](const Vec3& x) { return x.x > 6 || x.y < 0; };
  return body;
}

/// From a hole between a = 6 and 10, behind which the body is whole.
CrackedBody hole(bool flat) {
  CrackedBody body = from_six("hole", flat);
  body.solid = [](const Vec3& x) { return x.x < 6 || x.x > 10 || std::abs(x.y) > 3; };
  body.doubled = [](const Vec3& x) { return 10 <= x.x && x.x < 24; };
  body.side = {};
  body.times = planes(0, 7, 7);
  body.displacement = [](const Vec3& x, int side, double t) {
    const double tip = 10 + 2 * t;
    return Vec3{0, 0.02 * t * around_slit(x.x - (6 + tip) / 2, x.y, (tip - 6) / 2, side), 0};
  };
  return body;
}

/// From the edge to a hole between a = 10 and 14, beyond which the body is whole; all of it opens at once.
CrackedBody into_hole(bool flat) {
  CrackedBody body = from_six("into a hole", flat);
  body.solid = [](const Vec3& x) { return x.x < 10 || x.x > 14 || std::abs(x.y) > 3; };
  body.doubled = [](const Vec3& x) { return x.x <= 10; };
  body.side = {};
  body.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 14, x.y, side);
  };
  return body;
}

CrackedBody curved(CrackedBody body) {
  body.name += ", curved";
  body.place = [](const Vec3& x) {
    const double turn = x.x / 60;
    return Vec3{(60 - x.y) * std::sin(turn), 60 - (60 - x.y) * std::cos(turn), x.z};
  };
  return body;
}

/// The face that continues the lip bends out of the plane of the crack, to its other side.
CrackedBody corner_with_a_bent_face(bool flat) {
  CrackedBody body = corner(flat);
  body.name += ", its face bent";
  body.place = [](const Vec3& x) { return Vec3{x.x, x.y + 0.02 * std::pow(std::max(0., 6 - x.x), 2), x.z}; };
  return body;
}

/// Through the upper wall of a hollow body, whose lower one, in the same plane, is whole.
CrackedBody through_a_wall() {
  CrackedBody body = edge_crack();
  body.name = "through a wall of a hollow body";
  body.a = planes(0, 30, 30), body.b = planes(-10, 10, 20), body.c = planes(-16, 0, 16);
  body.solid = [](const Vec3& x) { return std::abs(x.y) > 7 || x.z < -13 || x.z >= -3; };
  body.doubled = [](const Vec3& x) { return x.x < 24 && x.z >= -3; };
  body.displacement = [](const Vec3& x, int side, double t) {
    const double below = std::clamp((-3 - x.z) / 10, 0., 1.), share = 1 - below * below * (3 - 2 * below);
    return 0.01 * t * share * beside_front(x.x - 2 * t, x.y, side);
  };
  return body;
}

std::vector<CrackedBody> bodies() {
  std::vector<CrackedBody> list = {through_a_wall(),
                                   posed(through_a_wall(), "the same, turned", Pose::random(8))};
  for (const bool flat : {false, true})
    for (const CrackedBody& body :
         {corner_with_a_bent_face(flat), one_sided_notch(flat), curved(one_sided_notch(flat)), corner(flat),
          curved(corner(flat)), hole(flat), curved(hole(flat)), into_hole(flat), curved(into_hole(flat))}) {
      list.push_back(body);
      list.push_back(posed(body, body.name + ", turned", Pose::random(8)));
    }
  return list;
}

class Mouths : public testing::TestWithParam<std::size_t> {};

}  // namespace

TEST_P(Mouths, OpenWhereThePairsBegin) { expect_exact(bodies()[GetParam()]); }

/// The break ends between the walls: its field takes no knots for the wall that is whole.
TEST(HollowBody, IsCutThroughOneWallOnly) { EXPECT_LT(measured(through_a_wall()).bytes, 8000); }

INSTANTIATE_TEST_SUITE_P(, Mouths, testing::Range(std::size_t{0}, bodies().size()));

}  // namespace cleft
