// Bodies: the same physics wherever a body lies and however it is curved.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "solver/body_mesh.h"
#include "solver/snapshot/snapshot.h"
#include "solver/solve.h"
#include "tests/support/patch_body.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

Parameters small_case() {
  Parameters p;
  p.patch = {40, 40, 6};
  p.mesh.element_size = 2;
  p.cut.length = 12, p.cut.depth = 3;
  return p;
}

struct Solved {
  SolveReport report;
  std::vector<std::vector<Vec3>> frames;
};

Solved solved(const Parameters& p, const std::shared_ptr<const Body>& body) {
  const TemporaryFolder folder;
  SolveOptions options;
  options.body = body, options.estimate = false;
  const std::string out = folder / "case.h5";
  Solved s{solve_cases({{body ? parameters_of(*body, p) : p, out}}, options, MPI_COMM_WORLD, [](auto&) {})[0],
           {}};
  EXPECT_EQ(s.report.failure, "");
  const SnapshotReader reader(out);
  for (std::size_t f = 0; f < reader.snapshot().frames(); ++f) s.frames.push_back(reader.displacement(f));
  return s;
}

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::shared_ptr<const Body> shared(Body body) { return std::make_shared<const Body>(std::move(body)); }

}  // namespace

/// Nothing but the order of elimination differs.
TEST(Body, AFlatOneIsThePatch) {
  for (const double branch : {0., 4.}) {
    Parameters p = small_case();
    p.cut.branch = branch;
    const Solved patch = solved(p, {});
    const auto body = shared(body_of_patch(p, flat));
    p.cut.branch = 0;
    const Solved same = solved(p, body);
    ASSERT_EQ(same.frames.size(), patch.frames.size());
    for (std::size_t f = 0; f < patch.frames.size(); ++f)
      for (std::size_t n = 0; n < patch.frames[f].size(); ++n)
        ASSERT_LT(norm(same.frames[f][n] - patch.frames[f][n]), 1e-9 * patch.report.gape) << f << " " << n;
    EXPECT_NEAR(same.report.gape, patch.report.gape, 1e-9 * patch.report.gape);
  }
}

/// A body that lies elsewhere and turned opens alike.
TEST(Body, ItDoesNotMatterHowItLies) {
  Parameters p = small_case();
  p.skin.prestress = {0.01, 0.03, 0.004};
  const Solved here = solved(p, shared(body_of_patch(p, around_cylinder(40))));
  const Vec3 x = normalized({1, 2, -0.5}), z = normalized(cross(x, {0, 0, 1})), y = cross(z, x);
  const auto turned = [&](const Vec3& a) { return a.x * x + a.y * y + a.z * z; };
  const Solved there = solved(p, shared(body_of_patch(p, [&](const Vec3& at) {
                                BentPlace place = around_cylinder(40)(at);
                                place.position = turned(place.position) + Vec3{300, -20, 7};
                                for (Vec3& axis : place.axes) axis = turned(axis);
                                return place;
                              })));
  for (std::size_t n = 0; n < here.frames.back().size(); ++n)
    ASSERT_LT(norm(turned(here.frames.back()[n]) - there.frames.back()[n]), 1e-9 * here.report.gape);
}

/// Whatever the curvature: nothing moves before the cut, to the last bit.
TEST(Body, ItIsAtRestWhileItIsClosed) {
  const Parameters p = small_case();
  for (const double radius : {15., -30.}) {
    const Solved s = solved(p, shared(body_of_patch(p, around_cylinder(radius))));
    for (const Vec3& d : s.frames.front()) ASSERT_EQ(d, Vec3{});
    EXPECT_GT(s.report.gape, 0.5);
  }
}

/// Bone below holds the tissue: the cut opens less, and what is grown to it moves next to nothing.
TEST(Body, BoneHolds) {
  Parameters p = small_case();
  Body body = body_of_patch(p, flat);
  const Solved soft = solved(p, shared(body));
  body.support.assign(body.support.size(), Support::bone);
  const Solved held = solved(p, shared(body));
  EXPECT_LT(held.report.gape, 0.99 * soft.report.gape);
  double largest = 0;
  for (const auto& t : body.bottom)
    for (const int n : t) largest = std::max(largest, norm(held.frames.back()[n]));
  EXPECT_LT(largest, 2e-3 * held.report.gape);
}

TEST(Body, AFileHoldsAllOfIt) {
  const TemporaryFolder folder;
  Body body = body_of_patch(small_case(), around_cylinder(30));
  body.support.front() = Support::bone;
  write_body(folder / "body.h5", body);
  const Body read = read_body(folder / "body.h5");
  EXPECT_EQ(read.hash, body.hash);
  EXPECT_EQ(read.points, body.points);
  EXPECT_EQ(read.wedges, body.wedges);
  EXPECT_EQ(read.frames, body.frames);
  EXPECT_EQ(read.support, body.support);
  EXPECT_EQ(read.times, body.times);
}

TEST(Body, BadOnesAreRefusedWithTheirPlace) {
  const auto refusal = [](const std::function<void(Body&)>& spoil) {
    Body body = body_of_patch(small_case(), flat);
    spoil(body);
    return refusal_of([&] { check_body(body, "b"); });
  };
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "upper one",
                      refusal([](Body& b) { std::swap(b.wedges[5], b.wedges[70]); }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "turned inside out",
                      refusal([](Body& b) { b.points[40].z = -50; }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "row 3", refusal([](Body& b) { b.bottom[3][1] = 1 << 30; }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "two pairs",
                      refusal([](Body& b) { b.pairs[2].right = b.pairs[1].right; }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "released", refusal([](Body& b) { b.released.back() = 1; }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "increase", refusal([](Body& b) { b.times[2] = b.times[1]; }));
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "tension", refusal([](Body& b) { b.tension.pop_back(); }));
}

TEST(Body, WhatItCannotDoIsRefused) {
  Parameters p = small_case();
  p.model = Model::finite;
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "model = finite",
                      refusal_of([&] { check_body_case(p, "c.toml"); }));
}

}  // namespace cleft
