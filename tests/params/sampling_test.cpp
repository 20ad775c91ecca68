// Methods that draw cases from ranges: Latin hypercube and Sobol.
#include "params/sampling/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "params/parameters/table.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

// By name; all of them may be anything from 0 to 1.
const std::vector<std::string> names = {
    "cut.branch",     "cut.radius",      "foundation.side_stiffness", "foundation.stiffness",
    "mesh.cut_depth", "mesh.cut_length", "skin.prestress_u",          "skin.prestress_uv"};

/// A study that draws `names` between 0 and 1.
Study unit_study(const std::string& method, std::size_t count, std::uint64_t seed) {
  Study study;
  study.sampling = {method, count, seed};
  for (const std::string& name : names) study.vary.push_back({name, {}, Range{0, 1}});
  return study;
}

/// What was drawn, a row for each case. The cases need not be consistent.
std::vector<std::vector<double>> points_of(const Study& study) {
  std::vector<std::vector<double>> points;
  for (const Case& one : find_sampling(study.sampling.method, "here").sample(study)) {
    points.emplace_back();
    for (const Variation& v : study.vary)
      points.back().push_back(
          std::get<double>(get_parameter(one.parameters, find_parameter(v.name, "here"))));
  }
  return points;
}

std::vector<std::vector<double>> unit_points(const std::string& method, std::size_t count,
                                             std::uint64_t seed) {
  return points_of(unit_study(method, count, seed));
}

/// In which of `count` equal intervals of [0, 1) the points' coordinates lie.
std::vector<std::size_t> strata(const std::vector<std::vector<double>>& points, std::size_t coordinate,
                                std::size_t count) {
  std::vector<std::size_t> result;
  for (const auto& point : points)
    result.push_back(static_cast<std::size_t>(point[coordinate] * static_cast<double>(count)));
  return result;
}

std::set<std::size_t> as_set(const std::vector<std::size_t>& list) { return {list.begin(), list.end()}; }

std::vector<Case> cases_of_text(const std::string& text) {
  const TemporaryFolder folder;
  return cases_of(read_study(folder.write("study.toml", text)));
}

std::vector<std::string> hashes_of(const std::string& text) {
  std::vector<std::string> hashes;
  for (const Case& one : cases_of_text(text)) hashes.push_back(one.hash());
  return hashes;
}

std::string refusal_of(const std::string& text) {
  try {
    cases_of_text(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

void expect_message(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = refusal_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "missing: " << part << "\nin: " << message;
}

std::string drawn(const std::string& method, int count, int seed) {
  return "[vary]\n'skin.thickness' = { from = 1, to = 2 }\n"
         "'tissue.young_modulus' = { from = 0.001, to = 1, scale = 'log' }\n[sampling]\nmethod = '" +
         method + "'\ncount = " + std::to_string(count) + "\nseed = " + std::to_string(seed) + "\n";
}

}  // namespace

TEST(LatinHypercube, EveryStratumOfEveryRangeHoldsOneCase) {
  for (const std::size_t count : {1u, 2u, 37u, 500u}) {
    const auto points = unit_points("latin-hypercube", count, 3);
    ASSERT_EQ(points.size(), count);
    std::set<std::vector<std::size_t>> orders;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto order = strata(points, k, count);
      EXPECT_EQ(as_set(order).size(), count) << names[k];
      EXPECT_LT(*std::max_element(order.begin(), order.end()), count);
      orders.insert(order);
    }
    EXPECT_TRUE(count < 30 || orders.size() == names.size()) << "the ranges' orders must differ";
  }
}

TEST(LatinHypercube, PlacesInTheStrataAreSpread) {
  // Of 500 uniform numbers each tenth holds 50 in the mean, with a standard deviation of 6.7: 5 of them
  // are 34.
  const auto points = unit_points("latin-hypercube", 500, 3);
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<int> tenths(10, 0);
    for (const auto& point : points) ++tenths[std::fmod(point[k] * 500, 1) * 10];
    for (const int held : tenths) EXPECT_NEAR(held, 50, 34) << names[k];
  }
}

TEST(LatinHypercube, StrataOfALogarithmicRangeAreEqualFactors) {
  std::set<int> seen;
  for (const Case& one : cases_of_text(drawn("latin-hypercube", 30, 5)))
    seen.insert(static_cast<int>(std::log10(one.parameters.tissue.young_modulus / 0.001) * 10));
  EXPECT_EQ(seen.size(), 30u);
  EXPECT_EQ(*seen.begin(), 0);
  EXPECT_EQ(*seen.rbegin(), 29);
}

TEST(Sobol, SeedZeroIsTheSequenceOfJoeAndKuo) {
  // scipy.stats.qmc.Sobol(8, scramble=False).random(8)
  const std::vector<std::vector<double>> known = {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                                                  {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5},
                                                  {0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75},
                                                  {0.25, 0.75, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25},
                                                  {0.375, 0.375, 0.625, 0.875, 0.375, 0.125, 0.375, 0.875},
                                                  {0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375},
                                                  {0.625, 0.125, 0.875, 0.625, 0.625, 0.875, 0.125, 0.125},
                                                  {0.125, 0.625, 0.375, 0.125, 0.125, 0.375, 0.625, 0.625}};
  EXPECT_EQ(unit_points("sobol", 8, 0), known);
}

TEST(Sobol, PointsAreANetWhateverTheSeed) {
  // The first 2^k points: each of 2^k equal intervals of any coordinate holds one, and so does each box of
  // sides 2^-a, 2^-(k - a) of the first two coordinates, a (0, 2)-sequence.
  for (const std::uint64_t seed : {0u, 1u, 2u, 20261u}) {
    const auto points = unit_points("sobol", 64, seed);
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_EQ(as_set(strata(points, k, 64)).size(), 64u) << names[k];
    for (std::size_t along_first = 1; along_first <= 64; along_first *= 2) {
      const auto first = strata(points, 0, along_first), second = strata(points, 1, 64 / along_first);
      std::set<std::pair<std::size_t, std::size_t>> boxes;
      for (std::size_t i = 0; i < 64; ++i) boxes.insert({first[i], second[i]});
      EXPECT_EQ(boxes.size(), 64u) << along_first << " intervals of the first, seed " << seed;
    }
  }
}

TEST(Sobol, MoreCasesKeepTheEarlierOnes) {
  for (const int seed : {0, 7}) {
    const auto all = hashes_of(drawn("sobol", 100, seed));
    ASSERT_EQ(all.size(), 100u);
    for (const int count : {1, 2, 50, 99})
      EXPECT_EQ(hashes_of(drawn("sobol", count, seed)),
                std::vector<std::string>(all.begin(), all.begin() + count));
  }
}

TEST(Sampling, TheSeedAloneDecides) {
  for (const char* method : {"latin-hypercube", "sobol"}) {
    std::set<std::vector<double>> seen;
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
      const auto points = unit_points(method, 20, seed);
      EXPECT_EQ(points, unit_points(method, 20, seed));
      seen.insert(points.begin(), points.end());
    }
    EXPECT_EQ(seen.size(), 60u) << method;
  }
}

TEST(Sampling, ADrawnStudyFindsItsCasesAgain) {
  // From MT19937-64 written out in Python: studies that were run with an earlier version keep their cases.
  const std::vector<std::vector<double>> stratified = {{0.472978294178, 0.438936258685},
                                                       {0.535317890801, 0.899047195195},
                                                       {0.013773289626, 0.0993613636039},
                                                       {0.958130745133, 0.577132179157}};
  const std::vector<std::vector<double>> shifted = {{0.754385304153, 0.949301202893},
                                                    {0.254385304153, 0.449301202893},
                                                    {0.00438530415286, 0.699301202893},
                                                    {0.504385304153, 0.199301202893}};
  for (const auto& [method, known] :
       {std::pair("latin-hypercube", stratified), std::pair("sobol", shifted)}) {
    Study study = unit_study(method, 4, 7);
    study.vary.resize(2);
    EXPECT_EQ(points_of(study), known) << method;
  }
}

TEST(Sampling, HowNamesAreSpeltChangesNothing) {
  const std::string end = "[sampling]\nmethod = 'sobol'\ncount = 4\nseed = 3\n";
  EXPECT_EQ(
      hashes_of(
          "[vary]\n'skin.thickness' = { from = 1, to = 2 }\n'skin.prestress_v' = { from = 0, to = 1 }\n" +
          end),
      hashes_of("[vary]\nskin.thickness = { from = 1, to = 2 }\n'skin.prestress_v' = { from = 0, to = 1 }\n" +
                end));
}

TEST(Sampling, AGridTakesALogarithmicRange) {
  std::vector<double> values;
  for (const Case& one :
       cases_of_text("[vary]\n'tissue.young_modulus' = { from = 0.01, to = 1, count = 5, scale = 'log' }\n"))
    values.push_back(one.parameters.tissue.young_modulus);
  EXPECT_EQ(values, (std::vector<double>{0.01, 0.0316227766017, 0.1, 0.316227766017, 1}));
}

TEST(Sampling, EveryMistakeIsToldAtOnce) {
  expect_message(
      "[sampling]\nmethod = 'sobol'\ncount = 0\nseed = -1\nsede = 1\n[vary]\n'skin.thickness' = [1, 2]\n"
      "'cut.count' = { from = 1, to = 3 }\n'cut.frames' = { from = 1, to = 3 }\n"
      "'cut.depth' = { from = 1, to = 3, count = 4 }\n'tissue.young_modulus' = { from = 0, to = 1 }\n"
      "'skin.prestress_u' = { from = 0, to = 1, scale = 'log' }\n'skin.prestress_v' = { from = 0, to = 1, "
      "scale = "
      "'lg' }\n'skin.prestress_w' = { from = 0, to = 1 }\n'skin.young_modulus' = { form = 1, to = 2 }\n"
      "'patch.width' = { from = 40, to = 40 }\n'patch.length' = 3\n",
      {"line 3: sampling.count = 0: must be a whole number between 1 and 1000000",
       "line 4: sampling.seed = -1: must be a whole number",
       "line 5: unknown key 'sampling.sede' (did you mean 'seed'?)",
       "line 7: skin.thickness: sampling method 'sobol' draws from a range, { from = a, to = b }",
       "line 8: cut.count: takes whole numbers only", "line 9: cut.frames: takes texts only",
       "line 10: cut.depth: method 'sobol' draws as many cases as sampling.count says; remove count",
       "line 11: tissue.young_modulus = 0: must be greater than 0",
       "line 12: skin.prestress_u: from = 0, to = 1: with scale = \"log\" both must be greater than 0",
       "line 13: skin.prestress_v: scale = lg: must be \"linear\" or \"log\" (did you mean 'log'?)",
       "line 14: unknown parameter 'skin.prestress_w' (did you mean 'skin.prestress_",
       "line 15: unknown key 'form' in the range of skin.young_modulus (did you mean 'from'?)",
       "line 16: patch.width: from and to are the same", "line 17: patch.length: give { from = a, to = b }"});
}

TEST(Sampling, WhatIsMissingOrOutOfPlaceIsTold) {
  const std::string vary = "[vary]\n'skin.thickness' = { from = 1, to = 2 }\n";
  expect_message(vary + "[sampling]\nmethod = 'latin-hypercube'\n", {"line 3: ", "needs count = n"});
  expect_message("[sampling]\nmethod = 'sobol'\ncount = 3\n", {"draws from ranges; give them under [vary]"});
  expect_message(vary + "[sampling]\nmethod = 'latin-hypercub'\ncount = 3\n",
                 {"line 4: unknown sampling method 'latin-hypercub' (did you mean 'latin-hypercube'?)"});
  expect_message(vary + "[sampling]\nmethod = 3\n", {"line 4: sampling.method must be a text"});
  expect_message(vary + "[sampling]\nmethod = 'sobol'\ncount = 'many'\n",
                 {"line 5: sampling.count: must be"});
  expect_message(vary, {"line 2: skin.thickness: a range is { from = a, to = b, count = n }"});
  expect_message("[sampling]\nseed = 3\n[vary]\n'skin.thickness' = [1, 2]\n",
                 {"line 2: sampling.seed: method 'grid' takes the values under [vary]; remove seed"});
  expect_message("[vary]\n'skin.thickness' = [1, 2]\nskin.thickness = [1, 2]\n",
                 {"skin.thickness: stands twice"});
  expect_message("[vary]\n'cut.count' = { from = 1, to = 2, count = 3 }\n",
                 {"line 2: cut.count = 1.5: must be a whole number between 1 and 100"});
  expect_message("[vary]\n'cut.frames' = { from = 1, to = 2, count = 2 }\n", {"cut.frames: takes texts"});
}

TEST(Sampling, ASparseGridHasSmolyaksPointsAndAHigherLevelKeepsThem) {
  const auto points = [](int level, int dimensions) {
    Study study;
    study.sampling = {"sparse-grid", 0, 0, level};
    for (int k = 0; k < dimensions; ++k) study.vary.push_back({names[k], {}, Range{0, 1}});
    return points_of(study);
  };
  // Counts of nested Clenshaw-Curtis grids: Smolyak 1963; Novak and Ritter, Numer. Math. 75 (1996), table 1.
  EXPECT_EQ(points(1, 1).size(), 3u);
  EXPECT_EQ(points(3, 1).size(), 9u);
  EXPECT_EQ(points(2, 2).size(), 13u);
  EXPECT_EQ(points(3, 2).size(), 29u);
  EXPECT_EQ(points(2, 6).size(), 85u);
  const auto low = points(1, 3), high = points(2, 3);
  ASSERT_EQ(low.size(), 7u);
  EXPECT_TRUE(std::equal(low.begin(), low.end(), high.begin()));
  EXPECT_EQ(low.front(), (std::vector<double>{0.5, 0.5, 0.5}));
  const std::set<std::vector<double>> all(high.begin(), high.end());
  EXPECT_EQ(all.size(), 25u) << "no point twice";
  EXPECT_TRUE(all.contains({0, 1, 0.5}));
  EXPECT_TRUE(all.contains({0.5, 0.5, 0.853553390593}));
}

TEST(Sampling, AGroupThatIsVariedAloneHasPairsOfItsOwn) {
  const auto cases = cases_of_text(
      "[vary]\n'cut.curvature' = { from = -0.02, to = 0.02 }\n'skin.curvature_u' = { from = -0.02, to = 0.02 "
      "}\n"
      "'cut.tilt' = { from = -45, to = 45, alone = 'blade' }\n"
      "'cut.depth' = { from = 2, to = 4, alone = 'blade' }\n"
      "'cut.curvature_rate' = { from = -0.004, to = 0.004, alone = true }\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n");
  ASSERT_EQ(cases.size(), 13u + (4 + 4 + 4) + 4);
  int pairs = 0;
  for (const Case& one : cases) {
    const Parameters& p = one.parameters;
    const bool shape = p.cut.curvature != 0 || p.skin.curvature_u != 0, rate = p.cut.curvature_rate != 0,
               tilt = p.cut.tilt != 0, depth = p.cut.depth != 3;
    EXPECT_LE(shape + rate + (tilt || depth), 1);
    pairs += tilt && depth;
  }
  EXPECT_EQ(pairs, 4);
}

TEST(Sampling, RangesThatAreKeptApartHaveNoPair) {
  const std::string
      three =
          "[vary]\n'cut.curvature' = { from = -0.02, to = 0.02 }\n'cut.depth' = { from = 2, to = 4 }\n"
          "'skin.curvature_uv' = { from = -0.01, to = 0.01",
      end = " }\n[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n";
  const auto all = cases_of_text(three + end),
             apart = cases_of_text(three + ", not_with = ['cut.curvature']" + end);
  EXPECT_EQ(apart.size() + 4, all.size());
  std::size_t with_depth = 0;
  for (const Case& one : apart) {
    const Parameters& p = one.parameters;
    EXPECT_TRUE(p.cut.curvature == 0 || p.skin.curvature_uv == 0);
    with_depth += p.cut.depth != 3 && p.skin.curvature_uv != 0;
  }
  EXPECT_EQ(with_depth, 4u);
  const auto with = [&](const std::string& list) {
    return std::string(three).append(", not_with = ").append(list).append(end);
  };
  for (const char* wrong : {"['cut.tilt']", "['skin.curvature_uv']"})
    expect_message(with(wrong), {"not_with = [", "must name other ranges"});
  for (const char* wrong : {"[]", "'cut.depth'", "[1]"})
    expect_message(with(wrong), {"line 4: skin.curvature_uv: not_with: must be a list"});
  expect_message(three + ", alone = true, not_with = ['cut.depth']" + end, {"that are not alone; remove it"});
}

TEST(Sampling, OfACaseAndItsMirrorImageOneIsSolved) {
  const std::string vary =
      "[vary]\n'cut.curvature' = { from = -0.02, to = 0.02 }\n'cut.depth' = { from = 2, to = 4 }\n"
      "'cut.tilt' = { from = -45, to = 45 }\n'skin.curvature_uv' = { from = -0.01, to = 0.01, alone = true "
      "}\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n";
  const auto shape = [](const Case& one, double sign) {
    const Parameters& p = one.parameters;
    return std::array{sign * p.cut.curvature, sign * p.cut.tilt, sign * p.skin.curvature_uv, p.cut.depth};
  };
  std::map<std::array<double, 4>, int> solved;
  const auto some = cases_of_text("[case]\ncut.mirrored = 'true'\n" + vary), all = cases_of_text(vary);
  for (const Case& one : some) ++solved[shape(one, 1)];
  std::size_t own_images = 0;
  for (const Case& one : all) {
    const bool own = shape(one, 1) == shape(one, -1);
    EXPECT_EQ(solved[shape(one, 1)] + (own ? 0 : solved[shape(one, -1)]), 1);
    own_images += own;
  }
  EXPECT_EQ(own_images, 1 + 4u) << "those of another depth alone";
  EXPECT_EQ(2 * some.size(), all.size() + own_images);
}

TEST(Sampling, WhatIsVariedAloneStartsFromItsOwnValueAndHasNoPairs) {
  const auto cases = cases_of_text(
      "[case]\npatch.height = 9\n[vary]\n'cut.depth' = { from = 2, to = 4 }\n"
      "'cut.curvature_rate' = { from = -0.004, to = 0.004, alone = true }\n"
      "'patch.height' = { from = 5, to = 9, alone = true }\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n");
  ASSERT_EQ(cases.size(), 1 + 4 + 4 + 3u) << "a height of 9 is the middle's own";
  std::set<double> rates, heights;
  for (const Case& one : cases) {
    const Parameters& p = one.parameters;
    EXPECT_LE((p.cut.depth != 3) + (p.cut.curvature_rate != 0) + (p.patch.height != 9), 1);
    rates.insert(p.cut.curvature_rate), heights.insert(p.patch.height);
  }
  EXPECT_EQ(*rates.begin(), -0.004);
  EXPECT_EQ(*rates.rbegin(), 0.004);
  EXPECT_EQ(rates.size(), 5u);
  EXPECT_EQ(*heights.begin(), 5);
  const auto on_bone = cases_of_text(
      "[vary]\n'patch.height' = { from = 5, to = 8, alone = true, with = { 'patch.bottom' = 'bone' } }\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 1\n");
  ASSERT_EQ(on_bone.size(), 3u);
  EXPECT_EQ(on_bone[0].parameters.patch.bottom, PatchBottom::springs);
  EXPECT_EQ(on_bone[1].parameters.patch.bottom, PatchBottom::bone);
  EXPECT_EQ(on_bone[2].parameters.patch.height, 8);
  const std::string end = " }\n[sampling]\nmethod = 'sparse-grid'\nlevel = 1\n";
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, with = { 'cut.tilt' = 3 }" + end,
                 {"line 2: cut.depth: with: is of what is varied alone; add alone = true"});
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, alone = true, with = { 'cut.tlt' = 3 }" + end,
                 {"line 2: ", "cut.tlt", "cut.tilt"});
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, alone = true, with = 3" + end,
                 {"line 2: cut.depth: with: must be {"});
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, count = 3, alone = true }\n",
                 {"line 2: cut.depth: alone: is for sampling method \"sparse-grid\"; remove it"});
  expect_message(
      "[vary]\n'cut.depth' = { from = 2, to = 4, alone = 1 }\n[sampling]\nmethod = 'sparse-grid'\nlevel = "
      "1\n",
      {"line 2: cut.depth: alone: must be true or false, or in quotes the name of a group"});
}

TEST(Sampling, RangesThatShareAreADiamond) {
  const auto cases = cases_of_text(
      "[vary]\n'cut.curvature' = { from = -0.06, to = 0.06 }\n"
      "'cut.curvature_rate' = { from = -0.004, to = 0.004, shares = 'cut.curvature' }\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n");
  ASSERT_EQ(cases.size(), 13u);
  std::set<std::pair<double, double>> places;
  for (const Case& one : cases) {
    const Parameters& p = one.parameters;
    EXPECT_LE(std::abs(p.cut.curvature) / 0.06 + std::abs(p.cut.curvature_rate) / 0.004, 1 + 1e-9);
    places.emplace(p.cut.curvature, p.cut.curvature_rate);
  }
  for (const auto& place : {std::pair{0.06, 0.}, {-0.06, 0.}, {0., 0.004}, {0., -0.004}, {0.03, 0.002}})
    EXPECT_TRUE(places.contains(place)) << place.first << ", " << place.second;
  EXPECT_EQ(places.size(), 13u);
  const auto with_depth = cases_of_text(
      "[vary]\n'cut.curvature' = { from = -0.06, to = 0.06 }\n'cut.depth' = { from = 2, to = 4 }\n"
      "'cut.curvature_rate' = { from = -0.004, to = 0.004, shares = 'cut.curvature' }\n"
      "[sampling]\nmethod = 'sparse-grid'\nlevel = 2\n");
  EXPECT_EQ(std::ranges::count_if(with_depth,
                                  [](const Case& one) {
                                    const auto& cut = one.parameters.cut;
                                    return cut.depth == 2 && std::abs(cut.curvature) == 0.06;
                                  }),
            2)
      << "pairs with others are of whole ranges";
  const std::string end = " }\n[sampling]\nmethod = 'sparse-grid'\nlevel = 1\n";
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, shares = 'cut.tilt'" + end,
                 {"line 2: cut.depth: shares = \"cut.tilt\": must name another range"});
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, shares = 'cut.depth'" + end,
                 {"must name another range"});
  expect_message("[vary]\n'cut.depth' = { from = 2, to = 4, count = 3, shares = 'cut.tilt' }\n",
                 {"cut.depth: shares: is for ranges of sampling method \"sparse-grid\""});
}

TEST(Sampling, UnitTensionsMakeThreeCasesOfEach) {
  const auto cases = cases_of_text(
      "[vary]\n'cut.depth' = { from = 2, to = 4 }\n[sampling]\nmethod = 'sparse-grid'\nlevel = 1\n"
      "unit_tensions = true\n");
  ASSERT_EQ(cases.size(), 9u);
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(cases[i].parameters.cut.depth, (std::vector<double>{3, 2, 4}[i / 3]));
  const auto tension = [&](std::size_t i) { return cases[i].parameters.skin.prestress; };
  const Prestress a = tension(0), b = tension(1), c = tension(2);
  const double independent = a.uu * (b.vv * c.uv - b.uv * c.vv) - a.vv * (b.uu * c.uv - b.uv * c.uu) +
                             a.uv * (b.uu * c.vv - b.vv * c.uu);
  EXPECT_GT(independent, 0.1 * 0.01 * 0.01 * 0.01);
  for (const Prestress& one : {a, b, c}) EXPECT_GE(one.uu * one.vv, one.uv * one.uv) << "no compression";
}

TEST(Sampling, ALevelAndUnitTensionsThatDoNotFitAreTold) {
  const std::string vary = "[vary]\n'cut.depth' = { from = 1, to = 2 }\n";
  expect_message(vary + "[sampling]\nmethod = 'sparse-grid'\n", {"line 3: ", "needs level = n"});
  expect_message(vary + "[sampling]\nmethod = 'sparse-grid'\nlevel = 13\n",
                 {"line 5: sampling.level = 13: must be a whole number between 1 and 12"});
  expect_message(vary + "[sampling]\nmethod = 'sparse-grid'\nlevel = 1\ncount = 3\n",
                 {"line 6: sampling.count: method 'sparse-grid' takes level; remove count"});
  expect_message(vary + "[sampling]\nmethod = 'sobol'\ncount = 3\nlevel = 1\n",
                 {"line 6: sampling.level: method 'sobol' takes count and seed; remove level"});
  expect_message("[vary]\n'skin.prestress_v' = [0.01, 0.02]\n[sampling]\nunit_tensions = true\n",
                 {"line 3: sampling.unit_tensions sets the skin's prestress; remove skin.prestress_v"});
  expect_message("[case]\nmodel = 'finite'\n[vary]\n'cut.depth' = [1, 2]\n[sampling]\nunit_tensions = true\n",
                 {"line 5: sampling.unit_tensions: tensions are sums of others in the small model alone"});
  expect_message(vary + "[sampling]\nmethod = 'sparse-grid'\nlevel = 1\nunit_tensions = 1\n",
                 {"line 6: sampling.unit_tensions: must be true or false"});
}

TEST(Sampling, DrawnCasesThatDoNotFitAreNamed) {
  // Of the plain sequence 0, 1/2, 3/4, 1/4: 10, 40, 55 and 25 mm fit into 60 mm, of twice that two do not.
  const std::string end = " }\n[sampling]\nmethod = 'sobol'\ncount = 4\n";
  EXPECT_EQ(refusal_of("[case]\npatch.length = 60\n[vary]\n'cut.length' = { from = 10, to = 70" + end), "");
  const std::string message =
      refusal_of("[case]\npatch.length = 60\n[vary]\n'cut.length' = { from = 20, to = 140" + end);
  EXPECT_NE(message.find("study, cut.length = 80: cut.length = 80 mm: must be less"), std::string::npos)
      << message;
  EXPECT_NE(message.find("study, cut.length = 110: "), std::string::npos) << message;
  EXPECT_EQ(message.find("cut.length = 50"), std::string::npos) << message;
}

}  // namespace cleft
