// Cases solved together against the same cases solved alone.
#include <gtest/gtest.h>

#include "base/text.h"
#include "params/parameters/table.h"
#include "params/solve_hash.h"
#include "solver/compliance.h"
#include "solver/kept_patches.h"
#include "tests/solver/dense_patch.h"
#include "tests/solver/solved_snapshot.h"

namespace cleft {

namespace {

/// What a sum of unit series may differ by from the series of the sum, / the largest displacement: rounding,
/// times a condition of K below 1e4.
constexpr double rounding = 1e-12;

Parameters changed(Parameters p, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) set_from_text(p, assignment, "test");
  return p;
}

Parameters base() {
  return changed(small_patch(), {"mesh.cut_length=6", "mesh.cut_depth=2", "skin.prestress_uv=0.012"});
}

const std::vector<std::vector<std::string>> of_one_stiffness = {
    {},
    {"skin.prestress_v=0.05"},
    {"skin.prestress_u=0.2", "skin.prestress_v=0.002", "skin.prestress_uv=-0.008"},
    {"cut.contact=true"},
    {"cut.contact=true", "skin.prestress_u=0.3", "skin.prestress_v=0.01"},
    {"cut.frames=pair"},
    {"cut.length=4"},
    {"cut.length=4", "skin.prestress_v=0.05"},
    {"cut.depth=1", "cut.frames=pair"},
    {"cut.length=4", "cut.contact=true"},
    {"skin.prestress_u=0", "skin.prestress_v=0", "skin.prestress_uv=0"},
};

std::vector<Parameters> cases_of_one_stiffness() {
  std::vector<Parameters> cases;
  for (const auto& assignments : of_one_stiffness) cases.push_back(changed(base(), assignments));
  return cases;
}

/// Bit for bit, file against file; and against a file whose series was asked for in another way.
void expect_as_alone(const SolveReport& report, const Parameters& p) {
  ASSERT_EQ(report.failure, "");
  check_snapshot(report.out);
  const TemporaryFolder folder;
  const SolveReport alone = solve_into(folder, {p})[0];
  const Snapshot s = SnapshotReader(report.out).snapshot();
  EXPECT_EQ(s.case_hash, solve_hash(p));
  EXPECT_TRUE(read_text_file(report.out) == read_text_file(alone.out)) << report.out;
  const Eigen::MatrixXd u = displacement_of(report.out);
  if (p.skin.prestress.vv > 0) {
    EXPECT_GT(u.cwiseAbs().maxCoeff(), 1e-3);
  } else {
    EXPECT_EQ(u.cwiseAbs().maxCoeff(), 0);
  }
  for (std::size_t j = 0; j < s.frames(); ++j) {
    EXPECT_LT(s.residual_equilibrium[j], p.model == Model::finite ? 1e-7 : 1e-10);
    EXPECT_LT(s.residual_closure[j], 1e-12);
  }
  EXPECT_EQ(report.gape, alone.gape);
  EXPECT_EQ(report.largest_displacement, alone.largest_displacement);
  EXPECT_EQ(report.smallest_gap, alone.smallest_gap);
  EXPECT_EQ(report.frames, alone.frames);
  EXPECT_EQ(report.pairs, alone.pairs);
}

}  // namespace

/// Node by node, from the unknowns of a dense solve.
TEST(SolveCases, TheSnapshotHoldsTheFramesOfTheSystem) {
  for (const char* name : {"Branch", "MeshOfALargerCut"}) {
    const auto all = dense_cases();
    const Parameters p = std::find_if(all.begin(), all.end(), [&](const DenseCase& c) {
                           return std::string(c.name) == name;
                         })->parameters;
    const TemporaryFolder folder;
    const SolveReport report = solve_into(folder, {p})[0];
    ASSERT_EQ(report.failure, "");
    const DensePatch patch(p);
    const auto by_node = [&](const Eigen::VectorXd& u) {
      Eigen::VectorXd nodes(u.size());
      for (int n = 0; n < u.size() / 3; ++n)
        for (int axis = 0; axis < 3; ++axis) nodes(3 * n + axis) = u(patch.system.unknown(n, axis));
      return nodes;
    };
    const Eigen::MatrixXd frames = displacement_of(report.out);
    ASSERT_EQ(frames.cols(), static_cast<Eigen::Index>(patch.release.released.size()));
    double largest = 0;
    for (Eigen::Index j = 0; j < frames.cols(); ++j) {
      const int open = patch.release.released[j];
      const Eigen::VectorXd expected = by_node(patch.solve(patch.closure(patch.release, open), patch.load));
      EXPECT_LT(difference(frames.col(j), expected), 1e-10) << name << ", frame " << j;
      for (int n = 0; n < expected.size() / 3; ++n)
        largest = std::max(largest, (frames.col(j) - frames.col(0)).segment<3>(3 * n).norm());
    }
    EXPECT_NEAR(report.largest_displacement, largest, 1e-14);
    const std::vector<Vec3> start = {patch.mesh.start};
    const Eigen::VectorXd pressed = patch.solve(patch.closure(patch.release, 0),
                                                patch.whole(disc_loads(patch.mesh, patch.system, start)));
    EXPECT_LT(difference(array_of(report.out, "dent"), by_node(pressed)), 1e-10) << name;
  }
}

TEST(SolveCases, OfOneStiffnessAreAsAloneAfterOneFactorisation) {
  const TemporaryFolder folder;
  const std::vector<Parameters> cases = cases_of_one_stiffness();
  const std::vector<SolveReport> reports = solve_into(folder, cases);
  ASSERT_EQ(reports.size(), cases.size());
  int with_phases = 0;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    expect_as_alone(reports[c], cases[c]);
    EXPECT_EQ(reports[c].cases_sharing, static_cast<int>(cases.size()));
    EXPECT_EQ(reports[c].first_of_sharing, c == 0);
    EXPECT_EQ(reports[c].method, "direct");
    with_phases += !reports[c].phases.empty();
  }
  EXPECT_EQ(with_phases, 1);
  const auto& phases = reports[0].phases;
  for (const char* name : {"assemble", "factor", "compliance", "frames", "write"})
    EXPECT_EQ(std::count_if(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == name; }), 1)
        << name;
  EXPECT_LT(reports[3].smallest_gap, 1e-12) << "the lips must touch for contact to mean anything";
  EXPECT_GT(reports[3].smallest_gap, -1e-12);
  EXPECT_LT(reports[0].smallest_gap, -1e-3);
}

TEST(SolveCases, OfSeveralStiffnessesShareWithTheirOwn) {
  const TemporaryFolder folder;
  const std::vector<Parameters> cases = {
      base(),
      changed(base(), {"tissue.young_modulus=0.03"}),
      changed(base(), {"skin.prestress_v=0.04"}),
      changed(base(), {"tissue.young_modulus=0.03", "cut.length=4"}),
      changed(base(), {"skin.initial_stress_stiffness=true"}),
      changed(base(), {"skin.initial_stress_stiffness=true", "skin.prestress_v=0.04"}),
      changed(base(), {"mesh.cut_length=8"}),
      changed(base(), {"skin.law=fung", "tissue.law=st-venant-kirchhoff", "skin.stiffening=9"}),
      changed(base(), {"model=finite"}),
      changed(base(), {"model=finite", "skin.prestress_v=0.04"}),
      changed(base(), {"model=finite", "skin.law=fung"}),
      changed(base(), {"model=finite", "cut.length=4", "mesh.cut_length=6"}),
  };
  const std::vector<int> sharing = {3, 2, 3, 2, 1, 1, 1, 3, 2, 1, 1, 2};
  const std::vector<SolveReport> reports = solve_into(folder, cases);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    expect_as_alone(reports[c], cases[c]);
    EXPECT_EQ(reports[c].cases_sharing, sharing[c]) << c;
    EXPECT_EQ(reports[c].first_of_sharing, c != 2 && c != 3 && c != 7 && c != 11) << c;
  }
}

/// With elements, analyses and companions of the first.
TEST(SolveCases, OfOneMeshAreAsAlone) {
  const TemporaryFolder folder;
  const std::vector<Parameters> cases = {
      base(),
      changed(base(), {"tissue.young_modulus=0.03", "skin.prestress_v=0.05"}),
      changed(base(), {"skin.bending_stiffness=0.02"}),
      changed(base(), {"foundation.stiffness=0.02", "skin.thickness=1", "tissue.prestress_share=0.2"}),
      changed(base(), {"skin.bending_stiffness=0.05", "tissue.poisson_ratio=0.3"}),
      changed(base(), {"tissue.young_modulus=0.05", "cut.contact=true", "cut.length=4"}),
  };
  const std::vector<SolveReport> reports = solve_into(folder, cases);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    expect_as_alone(reports[c], cases[c]);
    const TemporaryFolder place;
    const ErrorEstimate alone = solve_into(place, {cases[c]})[0].estimate;
    ASSERT_TRUE(alone.expected && reports[c].estimate.expected) << c << alone.obstacle;
    EXPECT_EQ(reports[c].estimate.expected->mesh, alone.expected->mesh) << c;
    EXPECT_EQ(reports[c].estimate.expected->patch, alone.expected->patch) << c;
  }
}

TEST(SolveCases, PatchesAreKeptForTheirMesh) {
  KeptPatches kept;
  const auto make = [](const Parameters& p) {
    auto patch = std::make_shared<MeshedPatch>(make_patch_mesh(p), p, MPI_COMM_WORLD, Discretization(),
                                               KeepElements::yes);
    patch->chosen = make_frame_solver(patch->mesh, patch->system, Method::automatic, many_operations,
                                      [](const std::string&) {});
    return patch;
  };
  const auto patch = make(base());
  kept.keep(base(), patch);
  const Parameters stiffer = changed(base(), {"tissue.young_modulus=0.03"});
  EXPECT_EQ(kept.reassembled(stiffer), patch);
  EXPECT_EQ(patch->system.unit_loads(), make(stiffer)->system.unit_loads());
  for (const char* other : {"mesh.element_size=0.9", "skin.bending_stiffness=0.02", "mesh.cut_length=4"})
    EXPECT_EQ(kept.reassembled(changed(base(), {other})), nullptr) << other;
  EXPECT_EQ(kept.wants(changed(base(), {"model=finite"}), patch->mesh), KeepElements::no);
  PatchMesh large;
  large.points.resize(100000);
  EXPECT_EQ(kept.wants(base(), large), KeepElements::no);
}

TEST(SolveCases, OfOneStiffnessAreAsAloneByIterations) {
  SolveOptions options;
  options.method = Method::iterative;
  const TemporaryFolder folder;
  std::vector<Parameters> cases;
  for (const Parameters& p : cases_of_one_stiffness())
    if (!p.cut.contact) cases.push_back(p);
  const std::vector<SolveReport> reports = solve_into(folder, cases, options);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    EXPECT_EQ(reports[c].method, "iterative");
    ASSERT_EQ(reports[c].failure, "");
    if (cases[c].skin.prestress.vv == 0) continue;
    EXPECT_EQ(displacement_of(reports[c].out), solved_alone(cases[c], options));
    // Residuals of 1e-10, times the condition.
    EXPECT_LT(difference(displacement_of(reports[c].out), solved_alone(cases[c])), 1e-7);
  }
  EXPECT_FALSE(reports[0].iterations.empty());
}

/// More cases than are written at a time, with so many loads that their frames come in several blocks.
TEST(SolveCases, ManyAreAsAlone) {
  const TemporaryFolder folder;
  std::vector<Parameters> cases;
  for (int c = 0; c < 67; ++c) {
    cases.push_back(base());
    cases.back().skin.prestress.uu = 0.01 + 0.001 * c;
    if (c % 4 == 0) cases.back().cut.contact = true;
  }
  const std::vector<SolveReport> reports = solve_into(folder, cases);
  for (const SolveReport& report : reports) {
    EXPECT_EQ(report.failure, "");
    EXPECT_EQ(report.cases_sharing, 67);
  }
  for (const std::size_t c : {0, 1, 60, 63, 64, 66}) expect_as_alone(reports[c], cases[c]);
}

TEST(SolveCases, AFailureKeepsNoOtherCaseFromBeingWritten) {
  const TemporaryFolder folder;
  const std::vector<std::string> overflow = {"skin.prestress_v=1e308", "skin.prestress_uv=0"};
  const std::vector<Parameters> cases = {
      base(),
      changed(base(), overflow),  // as a sum of unit series, and solved for itself
      changed(changed(base(), overflow), {"cut.contact=true"}),
      changed(base(), {"tissue.young_modulus=1e14"}),  // its springs vanish in rounding
      changed(base(), {"skin.prestress_v=0.04"}),
      changed(base(), {"tissue.young_modulus=0.03"}),
  };
  const std::vector<SolveReport> reports = solve_into(folder, cases);
  for (const std::size_t c : {0, 4, 5}) expect_as_alone(reports[c], cases[c]);
  for (const std::size_t c : {1, 2})
    EXPECT_NE(reports[c].failure.find("orders of magnitude"), std::string::npos) << reports[c].failure;
  EXPECT_NE(reports[3].failure.find("not positive definite"), std::string::npos) << reports[3].failure;
  EXPECT_EQ(folder.entries(), 3) << "of what failed nothing is left";
}

TEST(SolveCases, UnitSeriesAddUpToAnyPrestress) {
  SolveOptions options;
  options.unit_prestress = true;
  const TemporaryFolder folder;
  const std::vector<Parameters> cases = {changed(base(), {"skin.prestress_uv=0"}),
                                         changed(base(), {"cut.length=4", "skin.prestress_v=0.05"})};
  const std::vector<SolveReport> reports = solve_into(folder, cases, options);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    ASSERT_EQ(reports[c].failure, "");
    check_snapshot(reports[c].out);
    const auto unit = [&](const char* d) {
      return array_of(reports[c].out, std::string("displacement_per_skin.prestress_") + d);
    };
    for (const auto& [u, v, uv] : {std::array{0.02, 0.05, -0.01}, {0., 0.03, 0.}, {0.04, 0.02, 0.02}}) {
      Parameters other = cases[c];
      other.skin.prestress = {u, v, uv};
      EXPECT_LT(difference(u * unit("u") + v * unit("v") + uv * unit("uv"), solved_alone(other)), rounding);
    }
    EXPECT_EQ(difference(displacement_of(reports[c].out), solved_alone(cases[c])), 0);
  }
}

}  // namespace cleft
