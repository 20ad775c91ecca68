// Bounds of the error of displacements that nobody solved, against dense matrices.
#include "solver/residual_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "tests/solver/dense_patch.h"
#include "tests/solver/solved_snapshot.h"

namespace cleft {

namespace {

const auto silent = [](const std::string&) {};

/// Another case of the same mesh, all of whose moduli differ, by factors from .6 to 1.7.
Parameters other_moduli(Parameters p) {
  p.tissue.young_modulus *= 1.4, p.tissue.poisson_ratio = 0.3;
  p.skin.young_modulus *= 0.7, p.skin.poisson_ratio = 0.35, p.skin.thickness *= 1.2;
  p.skin.bending_stiffness *= 0.9, p.foundation.stiffness *= 1.7, p.foundation.side_stiffness *= 0.8;
  return p;
}

/// A snapshot of the case with displacements that are its own but for a smooth change, whose closed pairs
/// are together.
std::string changed_snapshot(const TemporaryFolder& folder, const Parameters& p, double change) {
  const std::vector<SolveReport> reports = solve_into(folder, {p}, {.estimate = false});
  const SnapshotReader reader(reports[0].out);
  const Snapshot& s = reader.snapshot();
  const std::string out = folder / "changed.h5";
  SnapshotWriter writer(out, s);
  for (std::size_t frame = 0; frame < s.frames(); ++frame) {
    std::vector<Vec3> u = reader.displacement(frame);
    for (std::size_t n = 0; n < u.size(); ++n) {
      const Vec3& at = s.points[n];
      u[n] = u[n] + change * Vec3{std::sin(at.x + at.z), std::cos(at.y), 0.3 * at.x * std::sin(at.y)};
    }
    writer.write_frames(frame, u);
  }
  writer.finish(s);
  return out;
}

/// sqrt(e . K e) of each frame, with everything dense.
std::vector<double> errors_of(const DensePatch& patch, const std::string& snapshot) {
  const SnapshotReader reader(snapshot);
  std::vector<double> errors;
  for (std::size_t frame = 0; frame < reader.snapshot().frames(); ++frame) {
    Eigen::VectorXd e =
        -patch.solve(patch.closure(patch.release, patch.release.released[frame]), patch.load).col(0);
    const std::vector<Vec3> u = reader.displacement(frame);
    for (std::size_t n = 0; n < u.size(); ++n)
      for (int axis = 0; axis < 3; ++axis) e[patch.system.unknown(static_cast<int>(n), axis)] += u[n][axis];
    errors.push_back(std::sqrt(e.dot(patch.stiffness * e)));
  }
  return errors;
}

}  // namespace

TEST(StiffnessRatios, BoundTheStiffnessOfOneCaseByThatOfAnother) {
  const std::set<std::string> chosen = {"Plain", "MeanDilatation", "EffectiveFront", "OnBone"};
  std::vector<DenseCase> cases = dense_cases();
  cases.push_back({"OnBone", dense_patch_case()});
  cases.back().parameters.patch.bottom = PatchBottom::bone;
  cases.back().parameters.skin.bending_stiffness = 0.02;
  for (const DenseCase& one : cases) {
    if (!chosen.contains(one.name)) continue;
    const Parameters other = other_moduli(one.parameters);
    const DensePatch a(one.parameters), b(other);
    const StiffnessRatios ratios = stiffness_ratios(one.parameters, other);
    const Eigen::VectorXd exact = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                      a.stiffness, b.stiffness, Eigen::EigenvaluesOnly)
                                      .eigenvalues();
    EXPECT_LE(ratios.least, exact.minCoeff() * (1 + 1e-9)) << one.name;
    EXPECT_GE(ratios.greatest, exact.maxCoeff() * (1 - 1e-9)) << one.name;
    EXPECT_LT(ratios.greatest / ratios.least, 3 * exact.maxCoeff() / exact.minCoeff()) << one.name;
  }
}

TEST(ResidualBound, HoldsInEachFrameAndIsNear) {
  const TemporaryFolder folder;
  Parameters p = dense_patch_case();
  p.skin.edges = SkinEdges::held, p.skin.bending_stiffness = 0.01, p.tissue.prestress_share = 0.3;
  const Parameters reference = other_moduli(p);
  const std::string snapshot = changed_snapshot(folder, p, 0.01);
  const std::vector<double> errors = errors_of(DensePatch(p), snapshot);
  const SnapshotReader reader(snapshot);
  const SnapshotBound found = ResidualBound(reference, MPI_COMM_WORLD, silent).of(reader, true, snapshot);
  const double most = std::sqrt(found.ratios.greatest / found.ratios.least);
  EXPECT_LT(most, 3);
  EXPECT_LT(found.moved, 1e-12);
  ASSERT_EQ(found.frames.size(), errors.size());
  for (std::size_t j = 0; j < errors.size(); ++j) {
    EXPECT_NEAR(found.frames[j].error.value(), errors[j], 1e-9 * errors[j]) << j;
    EXPECT_GE(found.frames[j].bound, errors[j]) << j;
    EXPECT_LE(found.frames[j].bound, most * errors[j]) << j;
  }
}

TEST(ResidualBound, ByTheOwnStiffnessIsTheError) {
  const TemporaryFolder folder;
  const Parameters p = dense_patch_case();
  const std::string snapshot = changed_snapshot(folder, p, 0.01);
  const std::vector<double> errors = errors_of(DensePatch(p), snapshot);
  const SnapshotBound found =
      ResidualBound(p, MPI_COMM_WORLD, silent).of(SnapshotReader(snapshot), false, snapshot);
  for (std::size_t j = 0; j < errors.size(); ++j)
    EXPECT_NEAR(found.frames[j].bound, errors[j], 1e-8 * errors[j]) << j;
  const SnapshotBound solved =
      ResidualBound(p, MPI_COMM_WORLD, silent).of(SnapshotReader(folder / "0.h5"), false, "0.h5");
  EXPECT_LT(solved.frames.back().bound, 1e-8 * solved.frames.back().size);
}

TEST(ResidualBound, IsOfWhatKeepsClosedPairsTogether) {
  // Closed nodes that are apart by a distance are put together, and it is told.
  const TemporaryFolder folder;
  const Parameters p = dense_patch_case();
  const std::vector<SolveReport> reports = solve_into(folder, {p}, {.estimate = false});
  const SnapshotReader reader(reports[0].out);
  const Snapshot& s = reader.snapshot();
  const std::string out = folder / "apart.h5";
  SnapshotWriter writer(out, s);
  for (std::size_t frame = 0; frame < s.frames(); ++frame) {
    std::vector<Vec3> u = reader.displacement(frame);
    for (std::size_t k = static_cast<std::size_t>(s.released[frame]); k < s.pairs.size(); ++k)
      u[static_cast<std::size_t>(s.pairs[k][0])].y -= 0.02,
          u[static_cast<std::size_t>(s.pairs[k][1])].y += 0.02;
    writer.write_frames(frame, u);
  }
  writer.finish(s);
  const SnapshotBound found = ResidualBound(p, MPI_COMM_WORLD, silent).of(SnapshotReader(out), false, out);
  EXPECT_NEAR(found.moved, 0.02, 1e-12);
  EXPECT_LT(found.frames.back().bound, 1e-7 * found.frames.back().size);
}

TEST(ResidualBound, IsRefusedWhereItWouldNotHold) {
  const TemporaryFolder folder;
  Parameters p = dense_patch_case();
  const auto refused = [&](const Parameters& changed) {
    const std::string file = solve_into(folder, {changed}, {.estimate = false})[0].out;
    EXPECT_THROW(parameters_to_bound(SnapshotReader(file).snapshot(), file), InputError);
  };
  Parameters contact = p, tense = p, turning = p;
  contact.cut.contact = true, tense.skin.initial_stress_stiffness = true;
  turning.skin.turning_stiffness = 0.5;
  for (const Parameters& changed : {contact, tense, turning}) refused(changed);
  const std::string file = solve_into(folder, {p}, {.estimate = false})[0].out;
  Parameters longer = p;
  longer.patch.length += 1;
  EXPECT_THROW(ResidualBound(longer, MPI_COMM_WORLD, silent).of(SnapshotReader(file), false, file),
               InputError);
}

}  // namespace cleft
