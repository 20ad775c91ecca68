#include "encoder/modes/common_modes.h"

#include <gtest/gtest.h>

#include <random>

#include "encoder/field/file/field_file.h"
#include "encoder/field/unknowns.h"
#include "tests/interpolate/made_study.h"
#include "tests/support/damage.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Nothing at t = 0, and closed wherever the tissue is uncut.
std::vector<Vec3> tied_motion(unsigned seed) {
  const auto bases = tip_bases();
  const ControlTies ties = ties_of("tip", bases);
  std::vector<double> unknowns(3ul * static_cast<std::size_t>((bases[3].size() - 1) * ties.size()));
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (double& unknown : unknowns) unknown = normal(random);
  return control_points(ties, bases, unknowns);
}

/// Sums of three motions that keep uncut tissue closed, in weights that no few modes but three can give; of
/// different size, length of cut, and rung.
std::vector<StudyMember> sums_of_three(int cases) {
  std::vector<StudyMember> members;
  const std::vector<Vec3> motion[] = {tied_motion(1), tied_motion(2), tied_motion(3)};
  for (int n = 0; n < cases; ++n) {
    const CaseParameters p =
        parameters_with({{"tissue.young_modulus", 0.01 + 0.001 * n}, {"cut.length", 20. + n % 5}});
    const double size = 0.2 + 0.1 * n, x = std::fmod(0.819 * n, 1), y = std::fmod(0.671 * n, 1);
    std::vector<Vec3> points(motion[0].size());
    for (std::size_t k = 0; k < points.size(); ++k)
      points[k] = size * ((1 - x) * motion[0][k] + x * (1 - y) * motion[1][k] + x * y * motion[2][k]);
    Field field(make_parametrization("tip", geometry_with(p)), tip_bases(), points);
    field.parameters = recorded(p), field.case_hash = "case" + std::to_string(n),
    field.report.spline_error = 1e-6;
    for (const Place& place : nodes_of_millimetres())
      field.report.largest_displacement = std::max(field.report.largest_displacement,
                                                   norm(field.displacement(place.uvw, place.side, place.t)));
    const Field own = n % 3 == 1 ? finer(field, 0, 1.5) : n % 3 == 2 ? finer(field, 2, -0.7) : field;
    members.push_back({"case" + std::to_string(n), own});
    members.back().field.case_hash = field.case_hash;
  }
  return members;
}

PackedStudy packed_of(const std::vector<StudyMember>& members, const TemporaryFolder& folder) {
  std::vector<StudyCase> cases;
  for (const StudyMember& member : members) {
    cases.push_back({member.name, folder / (member.name + ".dffd"), member.field.parameters});
    write_field(cases.back().field_file, member.field);
  }
  return {study_records(cases)};
}

}  // namespace

TEST(CommonModes, CasesAreSumsOfAsManyAsThereAre) {
  const TemporaryFolder folder;
  const std::vector<StudyMember> members = sums_of_three(16);
  const PackedStudy own = packed_of(members, folder);
  for (const double error : {0.02, 0.001}) {
    const PackedStudy study = with_common_modes(own, error);
    EXPECT_GE(study.modes.quanta.size(), 3u);
    EXPECT_LE(study.modes.quanta.size(), 6u);  // some for what the steps of three leave
    EXPECT_LT(coefficient_bytes(study), coefficient_bytes(own) / 4);
    const std::string path = folder / "study.dffd";
    write_study(path, study.cases, study.modes);
    const StudyFile file(path);
    ASSERT_EQ(file.size(), 16);
    for (int i = 0; i < file.size(); ++i) {
      const Field field = file.field(i), &truth = members[i].field;
      EXPECT_GT(file.modes_error(i), 0);
      EXPECT_LE(file.modes_error(i), error);
      EXPECT_LE(distance_of(field, truth, nodes_of_millimetres()), 1.3 * error);  // between the places, too
      EXPECT_EQ(file.report(i).spline_error, 1e-6 + file.modes_error(i));
      EXPECT_EQ(field.report.spline_error, file.report(i).spline_error);
      EXPECT_EQ(field.parameters, truth.parameters);
      EXPECT_EQ(field.case_hash, truth.case_hash);
      EXPECT_EQ(file.coefficient_bytes(i), 0u);
      const double behind = truth.cut().start - 2, t = truth.duration();  // uncut: closed bit for bit
      EXPECT_EQ(field.displacement({behind, 0, 0}, Side::left, t),
                field.displacement({behind, 0, 0}, Side::right, t));
    }
  }
}

TEST(CommonModes, ACaseWithFurtherQuantitiesStandsByItself) {
  const TemporaryFolder folder;
  std::vector<StudyMember> members = sums_of_three(16);
  const CaseParameters p = parameters_with({{"tissue.young_modulus", 0.5}});
  std::vector<Vec3> points = tied_motion(4);
  for (Vec3& point : points)
    for (int c = 0; c < 3; ++c) point[c] = static_cast<float>(point[c]);  // as files hold it
  Field other(make_parametrization("tip", geometry_with(p)), tip_bases(), points);
  other.parameters = recorded(p), other.report.largest_displacement = 1;
  other.quantities.push_back({"stress", 1, std::vector<double>(points.size(), 0.5), 0.5, 0});
  members.push_back({"other", other});
  const PackedStudy own = packed_of(members, folder), study = with_common_modes(own, 0.005);
  EXPECT_GT(study.modes.quanta.size(), 0u);
  const std::string path = folder / "study.dffd";
  write_study(path, study.cases, study.modes);
  const StudyFile file(path);
  EXPECT_EQ(file.name(16), "other");
  EXPECT_EQ(file.modes_error(16), 0);
  EXPECT_TRUE(file.field(16).coefficients() == other.coefficients());
  EXPECT_EQ(file.field(16).quantities.size(), 1u);
}

/// With control points that are multiples of a part of the largest displacement.
std::vector<StudyMember> in_steps(std::vector<StudyMember> members, double part) {
  for (StudyMember& one : members)
    one.field = quantised(one.field, part * one.field.report.largest_displacement, 0.5);
  return members;
}

TEST(CommonModes, WhereTheyCostMoreCasesHaveCoarserSteps) {
  const TemporaryFolder folder;
  const std::vector<StudyMember> members = in_steps(sums_of_three(3), 1e-4);
  const PackedStudy own = packed_of(members, folder), study = with_common_modes(own, 0.01);
  EXPECT_TRUE(study.modes.quanta.empty());
  EXPECT_LT(coefficient_bytes(study), coefficient_bytes(own));
  const std::string path = folder / "study.dffd";
  write_study(path, study.cases, study.modes);
  const StudyFile file(path);
  ASSERT_EQ(file.size(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(file.modes_error(i), 0.005);
    EXPECT_LE(file.modes_error(i), 0.01 * (1 + 1e-9));
    const double off = distance_of(file.field(i), members[i].field, nodes_of_millimetres());
    EXPECT_LE(off, 1.2 * file.modes_error(i));  // some of these nodes are not among those that are compared
    EXPECT_GT(off, 0.5 * file.modes_error(i));
    EXPECT_EQ(file.report(i).spline_error, 1e-6 + file.modes_error(i));
    EXPECT_EQ(file.field(i).case_hash, members[i].field.case_hash);
    EXPECT_EQ(file.field(i).parameters, members[i].field.parameters);
  }
}

TEST(CommonModes, WhereStepsAreAsCoarseAlreadyNothingChanges) {
  const TemporaryFolder folder;
  const PackedStudy own = packed_of(in_steps(sums_of_three(3), 0.01), folder),
                    study = with_common_modes(own, 0.001);
  EXPECT_TRUE(study.modes.quanta.empty());
  ASSERT_EQ(study.cases.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(study.cases[i].record.coefficients, own.cases[i].record.coefficients);
    EXPECT_EQ(study.cases[i].modes_error, 0);
  }
}

TEST(CommonModes, DamageIsNoticed) {
  const TemporaryFolder folder;
  const std::vector<StudyMember> members = sums_of_three(16);
  const PackedStudy study = with_common_modes(packed_of(members, folder), 0.01);
  const std::string path = folder / "study.dffd";
  write_study(path, study.cases, study.modes);
  std::vector<std::vector<Vec3>> sound, found;
  const auto read = [&](const std::string& name) {
    found.clear();
    const StudyFile file(name);
    for (const int i : {0, 7, 15}) found.push_back(file.field(i).coefficients());
  };
  read(path);
  sound = found;
  EXPECT_EQ(unnoticed_damages(path, 150, read, [&] { return found == sound; }), 0);
}

}  // namespace cleft
