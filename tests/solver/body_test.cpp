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
  p.skin.bending_stiffness = 0.01;
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "skin.bending_stiffness = 0.01",
                      refusal_of([&] { check_body_case(Body{}, p, "c.toml"); }));
  Body body;
  body.materials = {{"fat", {}, 0.495}};
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "region fat of the body has poisson_ratio = 0.495",
                      refusal_of([&] { check_body_case(body, small_case(), "c.toml"); }));
}

/// Regions of one material are that material; one without moduli is the case's tissue.
TEST(Body, ARegionIsMadeOfItsMaterial) {
  Parameters p = small_case();
  Body body = body_of_patch(p, around_cylinder(40));
  p.tissue.young_modulus = 0.05, p.tissue.poisson_ratio = 0.3;
  const Solved as_one = solved(p, shared(body));
  body.materials = {{"all", 0.05, 0.3}, {"of the case"}};
  body.region.assign(body.wedges.size(), 0);
  const Solved as_region = solved(small_case(), shared(body));
  body.region.assign(body.wedges.size(), 1);
  const Solved of_case = solved(p, shared(body));
  for (std::size_t n = 0; n < as_one.frames.back().size(); ++n) {
    ASSERT_EQ(as_region.frames.back()[n], as_one.frames.back()[n]);
    ASSERT_EQ(of_case.frames.back()[n], as_one.frames.back()[n]);
  }
  EXPECT_GT(solved(small_case(), shared(body)).report.gape, 1.02 * as_one.report.gape);
}

TEST(Body, AFileHoldsItsRegions) {
  const TemporaryFolder folder;
  Body body = body_of_patch(small_case(), flat);
  const std::string without = hash_of(body);
  body.materials = {{"fat", 0.01}, {"deep muscle", {}, 0.4}};
  body.region.assign(body.wedges.size(), 1);
  body.region.front() = 0;
  write_body(folder / "body.h5", body);
  const Body read = read_body(folder / "body.h5");
  EXPECT_EQ(read.materials, body.materials);
  EXPECT_EQ(read.region, body.region);
  EXPECT_EQ(read.hash, body.hash);
  EXPECT_NE(read.hash, without);
  body.region[5] = 2;
  EXPECT_PRED_FORMAT2(testing::IsSubstring, "row 5: there is no region 2",
                      refusal_of([&] { check_body(body, "b"); }));
}

/// Under finite strains a flat body is the patch too, and it does not matter how a bent one lies.
TEST(Body, FiniteStrainsAreThoseOfThePatchAndDoNotSeeRotations) {
  Parameters p = small_case();
  p.patch = {24, 20, 6};
  p.model = Model::finite;
  p.skin.prestress = {0.01, 0.03, 0.004};
  const Solved patch = solved(p, {}), same = solved(p, shared(body_of_patch(p, flat)));
  const auto largest_difference = [](const Solved& a, const Solved& b, auto turned) {
    double largest = 0;
    for (std::size_t n = 0; n < a.frames.back().size(); ++n)
      largest = std::max(largest, norm(turned(a.frames.back()[n]) - b.frames.back()[n]));
    return largest;
  };
  EXPECT_LT(largest_difference(patch, same, [](const Vec3& a) { return a; }), 1e-5 * patch.report.gape);
  const Vec3 x = normalized({1, 2, -0.5}), z = normalized(cross(x, {0, 0, 1})), y = cross(z, x);
  const auto turned = [&](const Vec3& a) { return a.x * x + a.y * y + a.z * z; };
  const Solved here = solved(p, shared(body_of_patch(p, around_cylinder(40))));
  const Solved there = solved(p, shared(body_of_patch(p, [&](const Vec3& at) {
                                BentPlace place = around_cylinder(40)(at);
                                place.position = turned(place.position) + Vec3{300, -20, 7};
                                for (Vec3& axis : place.axes) axis = turned(axis);
                                return place;
                              })));
  EXPECT_LT(largest_difference(here, there, turned), 1e-5 * here.report.gape);
  EXPECT_GT(largest_difference(here, patch, [](const Vec3& a) { return a; }), 1e-2 * here.report.gape);
}

}  // namespace cleft
