#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "params/consistency.h"
#include "params/hash.h"
#include "params/parameters/table.h"
#include "params/solve_hash.h"
#include "tests/support/even_piece.h"

namespace cleft {

TEST(Parameters, EveryDefaultLiesInItsOwnRange) {
  const Parameters defaults;
  for (const Parameter& row : parameter_table())
    EXPECT_NO_THROW(check_value(row, get_parameter(defaults, row), "default")) << row.name;
  EXPECT_NO_THROW(check_consistency(defaults, "default"));
}

TEST(Parameters, EveryRowReachesAMemberOfItsOwn) {
  std::set<const void*> members;
  Parameters p;
  for (const Parameter& row : parameter_table()) members.insert(row.address(p));
  EXPECT_EQ(members.size(), parameter_table().size());
}

TEST(Parameters, RangesAreEnforced) {
  Parameters p;
  EXPECT_THROW(set_parameter(p, "skin.thickness", 0.0, "here"), InputError);
  EXPECT_THROW(set_parameter(p, "tissue.poisson_ratio", 0.5, "here"), InputError);
  EXPECT_THROW(set_parameter(p, "cut.count", 2.5, "here"), InputError);
  EXPECT_THROW(set_parameter(p, "cut.frames", Value("row"), "here"), InputError);
  EXPECT_THROW(set_parameter(p, "cut.frames", 1.0, "here"), InputError);
  EXPECT_THROW(set_parameter(p, "skin.thickness", Value("1.5"), "here"), InputError);
  set_from_text(p, "skin.thickness=2.5", "--set");
  EXPECT_EQ(p.skin.thickness, 2.5);
  EXPECT_THROW(set_from_text(p, "skin.thickness", "--set"), InputError);
  EXPECT_THROW(set_from_text(p, "skin.thickness=thick", "--set"), InputError);
}

TEST(Parameters, AnUnknownNameSuggestsTheNearest) {
  Parameters p;
  try {
    set_parameter(p, "tissue.youngs_modulus", 1.0, "case.toml, line 3");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "case.toml, line 3: unknown parameter 'tissue.youngs_modulus' (did you mean "
                 "'tissue.young_modulus'?)");
  }
}

TEST(Parameters, TheCutMustLieInThePatch) {
  for (const char* assignment :
       {"cut.length=100", "cut.depth=8", "mesh.element_size=16", "skin.prestress_uv=0.02",
        "skin.prestress_v=-0.1", "patch.width=1.5", "mesh.element_size=0.001"}) {
    Parameters p;
    set_from_text(p, assignment, "--set");
    EXPECT_THROW(check_consistency(p, "here"), InputError) << assignment;
  }
}

/// What check_consistency says; empty where it agrees. `assignments` are separated by blanks.
std::string verdict(const std::string& assignments) {
  Parameters p = even_piece();
  std::istringstream words(assignments);
  for (std::string one; words >> one;) set_from_text(p, one, "--set");
  try {
    check_consistency(p, "here");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Parameters, TheCutsShapeMustFitThePatchAndItsMesh) {
  const std::pair<const char*, const char*> refused[] = {
      {"mesh.cut_length=29", "mesh.cut_length = 29 mm: must be at least cut.length = 30 mm"},
      {"mesh.cut_depth=2", "mesh.cut_depth = 2 mm: must be at least cut.depth = 3 mm"},
      {"mesh.cut_length=60", "mesh.cut_length = 60 mm: must be less than patch.length = 60 mm"},
      {"mesh.cut_depth=8", "mesh.cut_depth = 8 mm: must be less than patch.height = 8 mm"},
      {"cut.depth=0.5 mesh.cut_depth=3",
       "mesh.element_size = 1 mm: must be less than twice cut.depth = 0.5 mm"},
      {"cut.length=1.5 mesh.cut_length=20", "mesh.element_size = 1 mm: at most half of cut.length = 1.5 mm"},
      {"cut.radius=14.3",
       "cut.radius = 14.3 mm: an arc of cut.length = 30 mm would turn by more than 60 degrees to either "
       "side; must be at least 14.324 mm"},
      {"cut.radius=19 mesh.cut_length=40", "an arc of mesh.cut_length = 40 mm would turn"},
      {"cut.radius=15 patch.width=15", "6.895 mm toward +v, where there are 7.5 mm beside the cut"},
      {"cut.radius=20 patch.length=27", "cut.length = 30 mm, 27.266 mm along u: must be less"},
      {"cut.tilt=60 patch.width=17", "cut.tilt = 60 degrees: the mesh would move by 7.794 mm"},
      {"cut.tilt=-60 patch.width=17", "mm toward -v, where there are 8.5 mm"},
      {"cut.tilt=45 cut.count=5 cut.spacing=8", "where there are 4 mm beside the cut"},
      {"cut.tilt=45 cut.branch=16", "where there are 4 mm beside the cut"},
      {"cut.count=9", "cut.count = 9, cut.spacing = 5 mm: the cuts take 40 mm"},
      {"cut.count=2 cut.branch=5", "cut.branch = 5 mm: a branch leaves a single cut, not cut.count = 2"},
      {"cut.branch=0.9", "cut.branch = 0.9 mm: must be at least mesh.element_size = 1 mm"},
      {"cut.branch=19.5", "cut.branch = 19.5 mm: must leave an element of mesh.element_size = 1 mm"},
  };
  for (const auto& [assignments, message] : refused)
    EXPECT_NE(verdict(assignments).find(message), std::string::npos)
        << assignments << ": " << verdict(assignments);
  for (const char* allowed :
       {"mesh.cut_length=30 mesh.cut_depth=3", "mesh.cut_length=59", "cut.radius=14.324",
        "cut.radius=15 patch.width=16", "cut.length=62 cut.radius=32 patch.length=58",
        "cut.tilt=60 patch.width=18", "cut.tilt=-60 cut.radius=20", "cut.count=8",
        "cut.count=3 cut.radius=20 cut.tilt=30", "cut.branch=19", "cut.branch=10 cut.radius=20 cut.tilt=30",
        "cut.depth=0.51 mesh.cut_depth=3"})
    EXPECT_EQ(verdict(allowed), "") << allowed;
}

TEST(Parameters, WhatHasNoMirrorImageAmongTheCasesDoesNotStandForIt) {
  EXPECT_EQ(verdict("cut.mirrored=true cut.tilt=20"), "");
  for (const std::string set : {"cut.radius=20", "cut.count=2", "cut.branch=5", "skin.fibre_share=0.5"})
    EXPECT_NE(verdict("cut.mirrored=true " + set).find("not with cut.mirrored = true"), std::string::npos)
        << set << ": " << verdict("cut.mirrored=true " + set);
}

TEST(Parameters, TheNodesOfAGradedMeshAreCounted) {
  // A cut of 2 x 1 mm in elements of 0.01 mm. Uniform: 6000 x 4000 x 800 elements. Grown by 1.1: along u
  // 200 + 2 * ln(1 + 0.1 * 2900) / ln(1.1) = 319, along v 2 * ln(1 + 0.1 * 2000) / ln(1.1) = 111,
  // along w 100 + ln(1 + 0.1 * 700) / ln(1.1) = 145.
  const std::string fine = "cut.length=2 cut.depth=1 mesh.element_size=0.01 ";
  EXPECT_NE(verdict(fine).find("about 19"), std::string::npos) << verdict(fine);
  EXPECT_EQ(verdict(fine + "mesh.grading=1.1"), "");
  const std::string finer = fine + "mesh.grading=1.1 mesh.element_size=0.0075";
  EXPECT_EQ(verdict(finer), "");  // 392 x 118 x 181
  EXPECT_NE(verdict(fine + "mesh.grading=1.1 mesh.element_size=0.005").find("nodes; at most 1e+07"),
            std::string::npos);  // 535 x 125 x 253
}

TEST(Parameters, AMembraneCarriesNoCompressionInBothDirectionsEither) {
  Parameters p;
  p.skin.prestress.uu = p.skin.prestress.vv = -0.1;
  EXPECT_THROW(check_consistency(p, "here"), InputError);
}

TEST(Hash, MatchesThePublishedVector) {  // FIPS 180-4: SHA-256 of "abc"
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Hash, EveryParameterChangesTheIdentity) {
  std::set<std::string> hashes = {solve_hash(Parameters())};
  for (const Parameter& row : parameter_table()) {
    Parameters p;
    if (row.is_text()) {
      set_parameter(p, row.name, row.choices.back(), "here");
    } else {
      const double value = std::get<double>(get_parameter(p, row));
      const double other = value * 0.75 + (row.greatest >= 1 || value == 0 ? 0.01 : 0);
      set_parameter(p, row.name, other < row.least || row.whole ? value + (row.whole ? 1 : 0.5) : other,
                    "here");
    }
    EXPECT_TRUE(hashes.insert(solve_hash(p)).second) << row.name;
  }
}

}  // namespace cleft
