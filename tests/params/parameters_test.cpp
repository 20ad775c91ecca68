#include "params/parameters.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "params/hash.h"

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
  for (const Parameter& row : parameter_table())
    std::visit([&](auto access) { members.insert(&access(p)); }, row.access);
  EXPECT_EQ(members.size(), parameter_table().size());
}

TEST(Parameters, RangesAreEnforced) {
  Parameters p;
  EXPECT_THROW(set_parameter(p, "skin.thickness", 0.0, "here"), InputError);
  EXPECT_THROW(set_parameter(p, "tissue.poisson_ratio", 0.5, "here"), InputError);
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
       {"cut.length=60", "cut.depth=8", "mesh.element_size=16", "skin.prestress_uv=0.02",
        "skin.prestress_v=-0.1", "patch.width=1.5", "mesh.element_size=0.001"}) {
    Parameters p;
    set_from_text(p, assignment, "--set");
    EXPECT_THROW(check_consistency(p, "here"), InputError) << assignment;
  }
}

TEST(Parameters, AMembraneCarriesNoCompressionInBothDirectionsEither) {
  Parameters p;
  p.skin.prestress_u = p.skin.prestress_v = -0.1;
  EXPECT_THROW(check_consistency(p, "here"), InputError);
}

TEST(Hash, MatchesThePublishedVector) {  // FIPS 180-4: SHA-256 of "abc"
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Hash, EveryParameterChangesTheIdentity) {
  std::set<std::string> hashes = {solve_hash(Parameters())};
  for (const Parameter& row : parameter_table()) {
    Parameters p;
    if (row.is_text())
      set_parameter(p, row.name, row.choices.back(), "here");
    else
      set_parameter(p, row.name,
                    std::get<double>(get_parameter(p, row)) * 0.75 + (row.greatest > 1 ? 0.01 : 0), "here");
    EXPECT_TRUE(hashes.insert(solve_hash(p)).second) << row.name;
  }
}

}  // namespace cleft
