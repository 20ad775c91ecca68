// Studies whose displacements are known everywhere.
#include "encoder/interpolate/study_interpolator.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/unknowns.h"
#include "encoder/interpolate/compact.h"
#include "tests/interpolate/made_study.h"
#include "tests/support/stability_row.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

CaseParameters values_at(double x, double y, double z) {
  return {{"tissue.young_modulus", 0.01 * std::pow(4, x)},
          {"cut.depth", 2 + 3 * y},
          {"skin.prestress_v", 0.01 + 0.04 * z}};
}

/// The corners, and a lattice that fills the box.
std::vector<CaseParameters> three_varied(int inside) {
  std::vector<CaseParameters> list;
  for (const double x : {0., 1.})
    for (const double y : {0., 1.})
      for (const double z : {0., 1.}) list.push_back(values_at(x, y, z));
  for (int n = 1; n <= inside; ++n)
    list.push_back(values_at(std::fmod(0.819 * n, 1), std::fmod(0.671 * n, 1), std::fmod(0.549 * n, 1)));
  return list;
}

/// Cases that are closed, bit for bit, where nothing is cut.
std::vector<StudyMember> closed_study() {
  auto members = made_study(three_varied(8));
  for (StudyMember& member : members) {
    Field closed = quantised(made_field(member.field.parameters.numbers()), 1e-4, 0.5);
    closed.parameters = member.field.parameters, closed.quantum = 0;
    member.field = closed;
  }
  return members;
}

std::string message_of(const StudyInterpolator& study, const CaseParameters& values) {
  try {
    study.at(values);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(StudyInterpolator, PredictsWhatLiesBetweenAndKnowsHowWell) {
  const StudyInterpolator study(CommonCases(made_study(three_varied(24))));
  int within = 0, held = 0;
  for (double x = 0.1; x < 1; x += 0.2)
    for (double y = 0.15; y < 1; y += 0.35)
      for (double z = 0.2; z < 1; z += 0.6) {
        const CaseParameters values = values_at(x, y, z);
        const Field field = study.at(values), truth = made_field(values);
        const double error = distance_of(field, truth, nodes_of_millimetres());
        EXPECT_LT(error, 1e-3);
        EXPECT_EQ(field.interpolation->outside, 0);
        EXPECT_EQ(field.interpolation->cases, 32);
        EXPECT_EQ(field.report.spline_error, field.interpolation->estimated_error);
        ++held, within += error <= 2 * field.interpolation->estimated_error;
      }
  EXPECT_GE(within, 0.95 * held) << "of " << held;
}

TEST(StudyInterpolator, GivesACasesOwnField) {
  const auto list = three_varied(12);
  const StudyInterpolator study(CommonCases(made_study(list)));
  for (const CaseParameters& values : list) {
    const Field field = study.at(values);
    EXPECT_LE(distance_of(field, made_field(values)), field.interpolation->estimated_error);
  }
}

TEST(StudyInterpolator, PrestressesSuperposeExactly) {
  // Three cases of other prestress alone: every further one is a sum of theirs, far outside them too.
  std::vector<CaseParameters> list;
  for (const auto& [u, v] : {std::pair{0.01, 0.03}, {0.02, 0.01}, {0., 0.05}})
    list.push_back({{"skin.prestress_u", u}, {"skin.prestress_v", v}});
  const StudyInterpolator study(CommonCases(made_study(list)));
  EXPECT_EQ(study.features().size(), 0);
  for (const auto& [u, v] : {std::pair{0.015, 0.02}, {0.3, 0.1}, {0.01, 0.}}) {
    const CaseParameters values = {{"skin.prestress_u", u}, {"skin.prestress_v", v}};
    const Field field = study.at(values);
    // Control points in single precision: 6e-8 of each case's, in sums of a few of them.
    EXPECT_LT(distance_of(field, made_field(values)), 2e-6);
    EXPECT_LT(field.interpolation->estimated_error, 1e-4);
    EXPECT_EQ(field.interpolation->outside, 0);
  }
}

TEST(StudyInterpolator, LipsThatTouchDoNotSuperpose) {
  // What is told of the cases decides, and then prestress is a feature like others.
  for (const auto& [name, value] :
       {std::pair("cut.contact", "true"), {"skin.initial_stress_stiffness", "true"}, {"model", "finite"}}) {
    auto members = made_study(three_varied(24));
    for (StudyMember& member : members) member.field.parameters.set(name, value);
    const StudyInterpolator study{CommonCases(members)};
    EXPECT_EQ(study.features().loading(), Loading::general);
    EXPECT_EQ(study.features().size(), 3);
    const Field field = study.at(values_at(0.4, 0.6, 0.5));
    const double error = distance_of(field, made_field(values_at(0.4, 0.6, 0.5)), nodes_of_millimetres());
    EXPECT_LT(error, 0.02);
    EXPECT_LE(error, 2 * field.interpolation->estimated_error);
    EXPECT_GT(study.at(values_at(0.5, 0.5, 2)).interpolation->outside, 0.1);
  }
}

TEST(StudyInterpolator, SaysHowFarOutsideItIsAsked) {
  const StudyInterpolator study(CommonCases(made_study(three_varied(12))));
  const double inside = study.at(values_at(0.5, 0.5, 0.5)).interpolation->estimated_error;
  const Field beyond = study.at(values_at(1.5, 0.5, 0.5));
  EXPECT_NEAR(beyond.interpolation->outside, 0.5, 0.01);  // half the spread of the logarithm
  EXPECT_GT(beyond.interpolation->estimated_error, inside);
  // Prestress superposes: none lies outside as long as its direction is known.
  EXPECT_EQ(study.at(values_at(0.5, 0.5, 3)).interpolation->outside, 0);
  const auto outside = values_at(1.5, 0.5, 0.5);
  const double error = distance_of(beyond, made_field(outside), nodes_of_millimetres());
  record_limit({.method = "interpolation between cases",
                .limit = "parameters outside the study",
                .shown = "half the spread outside, the field is off by " + rounded(error) +
                         " of its largest displacement; in the middle the estimate is " + rounded(inside),
                .noticed = "`cleft interpolate` warns, and the file holds the distance from the study (" +
                           rounded(beyond.interpolation->outside) + ")",
                .then = "extrapolates; the estimated error grows to " +
                        rounded(beyond.interpolation->estimated_error)});
}

TEST(StudyInterpolator, TwoValuesDoNotPassForACurve) {
  // Cases left out tell nothing of what lies between two values; the estimate must not believe them.
  std::vector<CaseParameters> two, four;
  for (const double E : {0.01, 0.03}) {
    two.push_back({{"tissue.young_modulus", E}});
    for (const double depth : {2., 5.}) four.push_back({{"tissue.young_modulus", E}, {"cut.depth", depth}});
  }
  for (const auto& list : {two, four}) {
    const StudyInterpolator study(CommonCases(made_study(list)));
    for (const double E : {0.013, 0.017, 0.025}) {
      CaseParameters values = {{"tissue.young_modulus", E}};
      if (list.size() == 4) values["cut.depth"] = 3.5;
      const Field field = study.at(values);
      const double error = distance_of(field, made_field(values), nodes_of_millimetres());
      EXPECT_LE(error, 2 * field.interpolation->estimated_error);
      EXPECT_LE(field.interpolation->estimated_error, 0.1);
    }
  }
}

/// Largest error of cases in between, of these values of one parameter with its derivatives or without.
double error_of_cases(const std::string& name, const std::vector<double>& values, bool derivatives) {
  std::vector<StudyMember> members;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Field field = made_field({{name, values[i]}});
    if (derivatives) field = with_derivative(field, name);
    field.parameters.set("cut.contact", "false");
    members.push_back({"case" + std::to_string(i), i == 1 ? finer(field, 2, -0.7) : field});
  }
  const StudyInterpolator study{CommonCases(members)};
  EXPECT_EQ(study.regression().covariance().name.ends_with(" with derivatives"), derivatives);
  double worst = 0;
  for (double part = 0.05; part < 1; part += 0.1) {
    const CaseParameters at = {{name, values.front() * std::pow(values.back() / values.front(), part)}};
    const Field field = study.at(at);
    const double error = distance_of(field, made_field(at), nodes_of_millimetres());
    EXPECT_LE(error, 2 * field.interpolation->estimated_error) << name << " " << at.at(name);
    worst = std::max(worst, error);
  }
  return worst;
}

TEST(StudyInterpolator, WithDerivativesThreeCasesDoForMore) {
  for (const auto& [name, least] : {std::pair("tissue.young_modulus", 0.005), {"skin.prestress_v", 0.01}}) {
    std::vector<double> three, five;
    for (int i = 0; i < 3; ++i) three.push_back(least * std::pow(4., i));
    for (int i = 0; i < 5; ++i) five.push_back(least * std::pow(2., i));
    const double with = error_of_cases(name, three, true), without = error_of_cases(name, three, false);
    EXPECT_LE(with, name == std::string("skin.prestress_v") ? 1e-4 : without / 4) << name;
    if (name == std::string("tissue.young_modulus")) {
      EXPECT_LE(with, error_of_cases(name, five, false));
    }
  }
}

TEST(StudyInterpolator, UncutTissueStaysClosedToTheLastBit) {
  // All cases are closed where nothing is cut; so is what lies between, also as it is written.
  const StudyInterpolator study{CommonCases(closed_study())};
  const TemporaryFolder folder;
  const Field field = study.at(values_at(0.3, 0.4, 0.7));
  write_field(folder / "floats.dffd", field);
  const Field small = compact(field, 0.01 * field.report.largest_displacement);
  EXPECT_GT(small.quantum, 0);
  EXPECT_LE(distance_of(small, field), 0.02);
  write_field(folder / "small.dffd", small);
  for (const char* name : {"floats.dffd", "small.dffd"}) {
    const Field read = read_field(folder / name);
    ASSERT_TRUE(read.interpolation);
    EXPECT_EQ(read.interpolation->estimated_error, field.interpolation->estimated_error);
    EXPECT_EQ(read.interpolation->method, field.interpolation->method);
    for (double t = 0; t <= 24; t += 0.7)
      for (double u = -30; u <= 30; u += 0.9)
        for (const double w : {0., -1., -5., -8.}) {
          const bool cut = u > -12 && u < -12 + t && w > -read.cut().depth;
          if (cut) continue;
          EXPECT_EQ(read.displacement({u, 0, w}, Side::left, t),
                    read.displacement({u, 0, w}, Side::right, t));
        }
    EXPECT_EQ(read.displacement({3, 1, -1}, Side::both, 0), Vec3{});
  }
}

TEST(StudyInterpolator, AFileAddsNoMoreThanTheFitsHoweverLargeTheEstimate) {
  Field field = StudyInterpolator(CommonCases(closed_study())).at(values_at(0.3, 0.4, 0.7));
  const double fit = 0.01;
  for (const double between : {0., 0.05, 3.}) {
    field.interpolation->interpolation_error = between;
    field.interpolation->estimated_error = field.report.node_error = std::hypot(fit, between);
    const Field small = compact_interpolated(field);
    EXPECT_GT(small.quantum, 0.01 * fit * field.report.largest_displacement) << between;  // few bytes
    EXPECT_LE(distance_of(small, field), 0.1 * fit) << between;
  }
}

TEST(StudyInterpolator, MeshesThatRoundTheCutStandForTheCutTheyHave) {
  // Asked for 2.1, 2.9, 4.2 mm, with nodes at whole ones.
  auto list = three_varied(12);
  std::vector<StudyMember> members;
  for (std::size_t i = 0; i < list.size(); ++i) {
    CaseParameters solved = list[i];
    solved["cut.depth"] = std::round(solved["cut.depth"]);
    Field field = made_field(solved);
    RecordedParameters& p = field.parameters;
    p.set(p->cut.depth, list[i]["cut.depth"]), p.set(p->mesh.cut_depth, 6);
    p.set("cut.contact", "false");
    members.push_back({"case" + std::to_string(i), field});
  }
  const StudyInterpolator study{CommonCases(members)};
  const Field field = study.at(values_at(0.4, 0.5, 0.6));
  EXPECT_NEAR(field.cut().depth, 3.5, 1e-9);
  EXPECT_LT(distance_of(field, made_field(values_at(0.4, 0.5, 0.6))), 0.02);
}

TEST(CommonCases, MirrorImagesHaveTheOtherSignAcrossAndSoDoDerivativesByTilt) {
  std::vector<StudyMember> members;
  for (const double tilt : {0., 20.}) {
    Field field = with_derivative(made_field({{"cut.depth", 2 + tilt / 10}}), "cut.depth");
    ParameterDerivative by_tilt = field.by_parameter[0];
    by_tilt.parameter = "cut.tilt";
    field.by_parameter.push_back(by_tilt);
    field.parameters.set("cut.tilt", tilt), field.parameters.set("cut.mirrored", "true");
    members.push_back({"tilt" + std::to_string(static_cast<int>(tilt)), field});
  }
  const CommonCases cases(members);
  ASSERT_EQ(cases.size(), 3);  // the upright one is its own image
  const CommonCase &own = cases.cases()[1], &image = cases.cases()[2];
  EXPECT_EQ(image.parameters.number("cut.tilt"), -20);
  EXPECT_EQ(image.parameters.number("cut.depth"), own.parameters.number("cut.depth"));
  const auto compare = [&](std::span<const float> points, std::span<const float> mirrored, double sign) {
    const Field a = cases.field_of(points_of(points), own.geometry),
                b = cases.field_of(points_of(mirrored), image.geometry);
    double most = 0;
    for (const Place& at : all_kinds_of_places(a)) {
      const Side other = at.side == Side::left ? Side::right : at.side == Side::right ? Side::left : at.side;
      const Vec3 x = a.displacement(at.uvw, at.side, at.t),
                 y = b.displacement({at.uvw.x, -at.uvw.y, at.uvw.z}, other, at.t);
      EXPECT_LT(norm(sign * Vec3{x.x, -x.y, x.z} - y), 1e-6);
      most = std::max(most, norm(x));
    }
    EXPECT_GT(most, 0.01);
  };
  compare(cases.control_points(1), cases.control_points(2), 1);
  int compared = 0;
  for (std::size_t d = 0; d < cases.derivatives().size(); ++d)
    for (std::size_t e = 0; e < cases.derivatives().size(); ++e) {
      const CommonDerivative &one = cases.derivatives()[d], &two = cases.derivatives()[e];
      if (one.of != 1 || two.of != 2 || one.parameter != two.parameter) continue;
      compare(cases.derivative_points(d), cases.derivative_points(e), one.parameter == "cut.tilt" ? -1 : 1);
      ++compared;
    }
  EXPECT_EQ(compared, 2);
}

TEST(StudyInterpolator, WrongParametersAreNamed) {
  const StudyInterpolator study(CommonCases(made_study(three_varied(4))));
  const auto with = [&](const std::string& name, double value) {
    CaseParameters values = values_at(0.5, 0.5, 0.5);
    values[name] = value;
    return message_of(study, values);
  };
  EXPECT_NE(with("cut.deph", 3).find("did you mean 'cut.depth'?"), std::string::npos);
  EXPECT_NE(with("tissue.young_modulus", -1).find("must be greater than 0 MPa"), std::string::npos);
  EXPECT_NE(with("patch.length", 50).find("it is 60 in all cases"), std::string::npos);
  EXPECT_NE(with("cut.depth", std::nan("")).find("cut.depth"), std::string::npos);
  EXPECT_NE(with("cut.depth", 9).find("patch.height"), std::string::npos);
  EXPECT_EQ(with("patch.length", 60), "");
  EXPECT_NE(message_of(study, {{"cut.depth", 3}})
                .find("tissue.young_modulus varies in this study, from 0.01 to 0.04"),
            std::string::npos);
}

TEST(StudyInterpolator, CasesAreCheckedWithTheFormulationOfTheStudy) {
  const CaseParameters values = {{"tissue.young_modulus", 0.015}};
  const std::pair<const char*, const char*> expected[] = {{"displacement", "above 0.49 linear wedges lock"},
                                                          {"mean-dilatation", ""}};
  for (const auto& [formulation, message] : expected) {
    std::vector<CaseParameters> list;
    for (const double E : {0.01, 0.02, 0.04})
      list.push_back({{"tissue.young_modulus", E}, {"tissue.poisson_ratio", 0.495}});
    auto members = made_study(list);
    for (StudyMember& member : members) member.field.parameters.set("tissue.formulation", formulation);
    const std::string found = message_of(StudyInterpolator(CommonCases(members)), values);
    EXPECT_EQ(found.empty(), std::string(message).empty()) << found;
    EXPECT_NE(found.find(message), std::string::npos) << found;
  }
}

TEST(CommonCases, OlderCasesAreThoseWithoutWhatIsZeroByDefault) {
  auto members = made_study(three_varied(2));
  for (StudyMember& member : members) member.field.parameters.set("skin.bending_stiffness", 0.);
  members[1].field.parameters.set("skin.turning_stiffness", 0.);
  EXPECT_NO_THROW(CommonCases{members});
}

TEST(CommonCases, HowTissueIsDiscretisedIsNoChoice) {
  auto members = made_study(three_varied(2));
  for (StudyMember& member : members) member.field.parameters.set("tissue.formulation", "displacement");
  members[1].field.parameters.set("tissue.formulation", "mean-dilatation");
  const CommonCases cases(members);
  EXPECT_EQ(cases.size(), static_cast<int>(members.size()));
  for (const CommonCase& one : cases.cases())
    EXPECT_FALSE(one.parameters.texts().contains("tissue.formulation"));
}

TEST(CommonCases, WhatCannotBeCombinedIsRefused) {
  const auto refuses = [](const std::vector<StudyMember>& members, const std::string& part) {
    try {
      CommonCases{members};
      ADD_FAILURE() << "expected: " << part;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  const auto members = made_study(three_varied(2));
  refuses({}, "no case");
  refuses({members[0]}, "one case");
  refuses({members[0], members[0]}, "one case");
  auto other = members;
  other[1].field = random_field();
  refuses(other, "different parametrisations");
  other = members, other[1].field.parameters.set("cut.contact", "true");
  refuses(other, "differ in cut.contact");
  other = members, other[2].field.parameters.erase("cut.depth");
  refuses(other, "no parameter cut.depth");
  // A cut through the bottom has no knots below it.
  auto bases = tip_bases();
  bases[2] = BSplineBasis::uniform(3, 6, -1, 0);
  other = members,
  other[1].field = Field(members[1].field.shared_parametrization(), bases, random_coefficients(bases));
  other[1].field.parameters = members[1].field.parameters;
  refuses(other, "no common knots in height");
}

TEST(CommonCases, AreFittedAlikeWithTheSameKnotsAndTheSameGivenRegularisation) {
  const std::vector<StudyMember> all = made_study(three_varied(4));
  std::vector<StudyMember> members = {all[0], all[3]};  // every third is on the same knots
  EXPECT_FALSE(CommonCases{members}.fitted_alike()) << "each chose its own";
  for (StudyMember& one : members) one.field.report.regularisation = 3e-5;
  EXPECT_TRUE(CommonCases{members}.fitted_alike());
  members.push_back(all[1]);
  members.back().field.report.regularisation = 3e-5;
  EXPECT_FALSE(CommonCases{members}.fitted_alike()) << "other knots";
  members.pop_back();
  members.back().field.report.regularisation = 1e-5;
  EXPECT_FALSE(CommonCases{members}.fitted_alike());
}

TEST(CommonCases, FixedBodiesOfOtherSizesShareTheirKnots) {
  // A field that is the same in parts of its body's length, width and height.
  std::vector<StudyMember> members;
  const auto body = [](double size, int along) {
    const std::array<BSplineBasis, 4> bases{BSplineBasis::uniform(3, along, -30 * size, 30 * size),
                                            BSplineBasis::broken(3, 10, -20 * size, 0, 20 * size),
                                            BSplineBasis::uniform(3, 5, -8 * size, 0),
                                            BSplineBasis::uniform(3, 6, 0, 24 * size)};
    std::vector<Vec3> points =
        random_coefficients({BSplineBasis::uniform(3, 7, 0, 1), bases[1], bases[2], bases[3]});
    if (along == 11)
      points = insert_knots(
          points, {BSplineBasis::uniform(3, 7, -30 * size, 30 * size), bases[1], bases[2], bases[3]}, bases);
    Field field(bases[0], bases[1], bases[2], bases[3], points, {-12 * size, 24 * size, 3 * size});
    field.parameters = recorded({{"size", size}});
    return field;
  };
  for (const double size : {1., 1.1, 1.7, 2.})
    members.push_back({std::to_string(size), body(size, size > 1.5 ? 11 : 7)});
  const StudyInterpolator study{CommonCases(members)};
  const Field field = study.at({{"size", 1.3}}), truth = body(1.3, 7);
  EXPECT_EQ(field.basis(0).size(), 11);
  EXPECT_NEAR(field.domain(0).back, 39, 1e-12);
  EXPECT_LT(distance_of(field, truth), 1e-6);
}

}  // namespace cleft
