// Three and more cuts that meet in one point: from there, or across.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/incision/meshes.h"
#include "tests/incision/stress/soundness.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double degree = std::numbers::pi / 180;

/// Straight through or from `at`, at an angle.
ScalpelPath straight(const Vec3& at, double angle, double from, double to, double depth) {
  const Vec3 along{std::cos(angle), std::sin(angle), 0};
  return path_through({at + from * along, at + (from + to) / 2 * along, at + to * along}, up, depth);
}

struct Outcome {
  std::string refusal, wrong;
};

/// Makes the cuts one after the other, and takes them back, and makes them again.
Outcome cut_all(const SurfaceMesh& plate, const std::vector<ScalpelPath>& paths, bool refine) {
  CutMesh mesh(plate);
  const int euler = stress::Soundness(mesh).euler();
  IncisionOptions options;
  if (!refine) options.max_edge = 0;
  std::vector<std::unique_ptr<Incision>> cuts;
  std::vector<std::vector<double>> states{state_of(mesh)};
  for (const ScalpelPath& path : paths) {
    const std::string number = "cut " + std::to_string(cuts.size() + 1) + ": ";
    try {
      cuts.push_back(std::make_unique<Incision>(mesh, path, options));
      cuts.back()->advance_to(path.length());
    } catch (const InputError& error) {
      return {number + error.what(), ""};
    }
    if (cuts.back()->tip() < 0.99 * path.length()) return {"", number + "ends early"};
    const stress::Soundness sound(mesh);
    if (sound.euler() != euler) return {"", number + "another Euler characteristic"};
    if (const std::string wrong = sound.whole(); !wrong.empty()) return {"", number + wrong};
    states.push_back(state_of(mesh));
  }
  for (std::size_t k = cuts.size(); k-- > 0;) {
    cuts[k]->undo();
    if (state_of(mesh) != states[k]) return {"", "undone otherwise"};
  }
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    cuts[k]->redo();
    if (state_of(mesh) != states[k + 1]) return {"", "redone otherwise"};
  }
  return {};
}

/// On a regular plate or, every second time, one with its vertices moved within the plane.
SurfaceMesh some_plate(int n, std::mt19937& random) {
  SurfaceMesh mesh = grid(24, 24, -12, -12, 1);
  std::uniform_real_distribution<double> aside(-0.15, 0.15);
  if (n % 2 == 1)
    for (Vec3& p : mesh.points)
      if (std::abs(p.x) < 12 && std::abs(p.y) < 12) p += Vec3{aside(random), aside(random), 0};
  return mesh;
}

/// A vertex, the middle of an edge, or a place within a triangle.
Vec3 some_place(int n, const SurfaceMesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 &a = mesh.points[12 * 25 + 12], &b = mesh.points[12 * 25 + 13];
  return n % 3 == 0 ? a : n % 3 == 1 ? 0.5 * (a + b) : Vec3{unit(random), unit(random), 0};
}

/// Three to five random directions, at least so many degrees apart.
std::vector<double> some_directions(double least, double period, std::mt19937& random) {
  std::uniform_real_distribution<double> degrees(0, 360);
  std::vector<double> angles;
  for (const std::size_t count = 3 + random() % 3; angles.size() < count;) {
    const double angle = degrees(random);
    if (std::all_of(angles.begin(), angles.end(),
                    [&](double other) { return std::abs(std::remainder(angle - other, period)) >= least; }))
      angles.push_back(angle);
  }
  return angles;
}

/// Refused of so many random meetings of cuts, each cut shifted by up to `aside`. Whatever is not refused is
/// sound.
int refused(int meetings, bool across, double aside) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1), around(-1, 1);
  int refused = 0;
  for (int n = 0; n < meetings; ++n) {
    const SurfaceMesh mesh = some_plate(n, random);
    const Vec3 at = some_place(n, mesh, random);
    std::vector<ScalpelPath> paths;
    std::string told = std::to_string(n) + ":";
    for (const double angle : some_directions(6, across ? 180 : 360, random)) {
      const double depth = std::vector<double>{1, 2, 3, 0.5 + 2 * unit(random)}[random() % 4];
      const double shift = aside > 0 ? aside * std::pow(10., -14 * unit(random)) : 0;
      paths.push_back(straight(at + shift * Vec3{around(random), around(random), 0}, angle * degree,
                               across ? -6 : 0, 6, depth));
      told += " " + std::to_string(angle) + "/" + std::to_string(depth);
    }
    const Outcome outcome = cut_all(mesh, paths, n % 8 < 4);
    EXPECT_EQ(outcome.wrong, "") << told;
    if (aside == 0) {
      EXPECT_EQ(outcome.refusal, "") << told;
    }
    refused += !outcome.refusal.empty();
  }
  return refused;
}

TEST(Meeting, CutsFromOnePoint) { EXPECT_EQ(refused(60, false, 0), 0); }
TEST(Meeting, CutsAcrossOnePoint) { EXPECT_EQ(refused(60, true, 0), 0); }
// Of 3,000 such meetings 7 are refused: pieces between two wounds that are nearer than a triangle.
TEST(Meeting, CutsFromAlmostOnePoint) { EXPECT_LE(refused(60, false, 0.1), 1); }
TEST(Meeting, CutsAcrossAlmostOnePoint) { EXPECT_LE(refused(60, true, 0.1), 1); }

/// Right angles and equal parts, where paths lie exactly on each other's lines, depths in every order.
TEST(Meeting, CutsAtEqualAngles) {
  const SurfaceMesh plate = grid(24, 24, -12, -12, 1);
  for (const bool refine : {false, true})
    for (const bool across : {false, true})
      for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0.5, 0, 0}, Vec3{0.31, 0.17, 0}})
        for (const int parts : {3, 4})
          for (const std::array<double, 4>& depths : {std::array{2., 2., 2., 2.}, {1., 2., 3., 2.}}) {
            std::vector<ScalpelPath> paths;
            for (const int k : {0, 2, 1, 3})
              if (k < parts)
                paths.push_back(straight(at, (across ? 180. : 360.) * k / parts * degree, across ? -6 : 0, 6,
                                         depths[paths.size()]));
            const Outcome outcome = cut_all(plate, paths, refine);
            EXPECT_EQ(outcome.wrong + outcome.refusal, "")
                << place_of(at) << ' ' << across << parts << refine;
          }
}

/// The second cut begins on the first one's lip, and leads to the side of its other lip.
TEST(Meeting, ACutFromALipBeginsOnTheLipThatItLeadsAwayFrom) {
  const SurfaceMesh plate = grid(24, 24, -12, -12, 1);
  for (const double angle : {40., 90., 130., -40., -90., -130.})
    for (const double x : {0.29, 0.5}) {
      SCOPED_TRACE(angle);
      CutMesh mesh(plate);
      Incision first(mesh, straight({0, 0.4, 0}, 0, -5, 5, 2));
      first.advance_to(100);
      const ScalpelPath path = straight({x, 0.4, 0}, angle * degree, 0, 4, 2);
      Incision second(mesh, path);
      second.advance_to(100);
      EXPECT_NEAR(second.tip(), path.length(), 1e-9);
      EXPECT_EQ(stress::Soundness(mesh).whole(), "");
      // Its own lips at the start are two, and the opposite lip of the first cut is whole.
      const Incision::ChainVertex& start = second.chain().front();
      EXPECT_NE(start.left, start.right);
      for (const int v : {start.left, start.right})
        EXPECT_EQ(mesh.vertex(v).kind, angle < 0 ? VertexKind::left_lip : VertexKind::right_lip);
      EXPECT_EQ(second.surroundings().stations().empty(), false);
    }
}

}  // namespace
}  // namespace cleft
