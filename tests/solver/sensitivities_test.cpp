// Derivatives of the series against differences of whole solves.
#include <gtest/gtest.h>

#include <cmath>

#include "params/parameters/table.h"
#include "tests/solver/small_patch.h"
#include "tests/solver/solved_snapshot.h"

namespace cleft {

namespace {

/// Over the step, / the parameter's distance from where the series is singular (0, or 1/2 of Poisson's
/// ratios): central differences of fourth order leave about step^4 = 1e-10 of the derivative, and rounding of
/// 1e-16, times a condition of 1e4, / step = 3e-10.
constexpr double step = 3e-3, tolerance = 1e-8;

Eigen::MatrixXd by_differences(const Parameters& p, const std::string& name) {
  const Parameter& row = find_parameter(name, "test");
  const double at = std::get<double>(get_parameter(p, row));
  const bool is_ratio = name.find("ratio") != std::string::npos;
  const double h = step * (is_ratio ? 0.5 - at : std::max(at, 0.01));
  const auto moved = [&](double steps) {
    Parameters q = p;
    std::get<0>(row.access)(q) = at + steps * h;
    return solved_alone(q);
  };
  return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * h);
}

const std::vector<std::string> of_the_stiffness = {
    "skin.young_modulus",   "skin.thickness",       "skin.poisson_ratio",       "tissue.young_modulus",
    "tissue.poisson_ratio", "foundation.stiffness", "foundation.side_stiffness"};
const std::vector<std::string> of_the_prestress = {"skin.prestress_u", "skin.prestress_v",
                                                   "skin.prestress_uv"};

Parameters sheared() {
  Parameters p = small_patch();
  p.skin.prestress.uv = 0.012, p.skin.poisson_ratio = 0.3, p.tissue.poisson_ratio = 0.35;
  return p;
}

void expect_derivatives(const std::vector<Parameters>& cases, const std::vector<std::string>& names,
                        Method method = Method::automatic, double largest_difference = tolerance) {
  SolveOptions options;
  options.method = method;
  options.sensitivities = names;
  const TemporaryFolder folder;
  const std::vector<SolveReport> reports = solve_into(folder, cases, options);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    ASSERT_EQ(reports[c].failure, "");
    check_snapshot(reports[c].out);
    EXPECT_LT(difference(displacement_of(reports[c].out), solved_alone(cases[c])), largest_difference);
    for (const std::string& name : names)
      EXPECT_LT(
          difference(array_of(reports[c].out, "displacement_per_" + name), by_differences(cases[c], name)),
          largest_difference)
          << name << " of case " << c;
  }
}

}  // namespace

/// Of two cases at once, so that one's derivatives are not the other's.
TEST(Sensitivities, AreTheDerivativesOfTheSeries) {
  Parameters first = sheared(), second = sheared();
  first.mesh.cut_length = second.mesh.cut_length = 6;
  first.cut.length = second.cut.length = 4;
  second.skin.prestress.uu = 0.05, second.skin.prestress.vv = 0.06;
  std::vector<std::string> names = of_the_stiffness;
  names.insert(names.end(), of_the_prestress.begin(), of_the_prestress.end());
  expect_derivatives({first, second}, names);
}

TEST(Sensitivities, KnowThatPrestressMayStiffenTheSkin) {
  Parameters p = sheared();
  p.skin.initial_stress_stiffness = true;
  std::vector<std::string> names = of_the_prestress;
  names.push_back("skin.thickness");
  expect_derivatives({p}, names);
}

TEST(Sensitivities, OfMeanDilatation) {
  Parameters p = sheared();
  p.tissue.formulation = TissueFormulation::mean_dilatation, p.tissue.poisson_ratio = 0.49;
  expect_derivatives({p}, {"tissue.poisson_ratio", "tissue.young_modulus"});
}

/// Residuals of 1e-10 of the derivative's own loads, times the condition.
TEST(Sensitivities, ByIterations) {
  expect_derivatives({sheared()}, {"skin.young_modulus", "tissue.poisson_ratio"}, Method::iterative, 1e-6);
}

TEST(Sensitivities, ToThePrestressAreTheUnitSeries) {
  SolveOptions units, derivatives;
  units.unit_prestress = true;
  derivatives.sensitivities = of_the_prestress;
  const TemporaryFolder first, second;
  const std::string by_units = solve_into(first, {sheared()}, units)[0].out;
  const std::string by_derivatives = solve_into(second, {sheared()}, derivatives)[0].out;
  // The derivative of K, which is 0, comes as a difference whose rounding the step of 1e-3 magnifies.
  for (const std::string& name : of_the_prestress) {
    const std::string array = "displacement_per_" + name;
    EXPECT_LT(difference(array_of(by_derivatives, array), array_of(by_units, array)), 1e-10) << name;
  }
}

/// Whole solves end at residuals of 1e-7 of the largest load, which the step of 3e-3 magnifies to 3e-5 of the
/// derivative times the condition of the tangent; most end far below that.
TEST(Sensitivities, UnderFiniteStrains) {
  Parameters p = sheared();
  p.model = Model::finite;
  p.skin.law = SkinLaw::fung, p.skin.fibre_share = 0.3, p.skin.fibre_angle = 20,
  p.skin.fibre_dispersion = 0.1;
  p.skin.bending_stiffness = 0.02, p.tissue.prestress_share = 0.1;
  std::vector<std::string> names = of_the_stiffness;
  names.insert(names.end(), of_the_prestress.begin(), of_the_prestress.end());
  names.insert(names.end(), {"skin.stiffening", "skin.fibre_share", "skin.fibre_angle",
                             "skin.fibre_dispersion", "skin.bending_stiffness", "tissue.prestress_share"});
  expect_derivatives({p}, names, Method::automatic, 1e-4);
  Parameters held = p;
  held.skin.edges = SkinEdges::held, held.skin.law = SkinLaw::neo_hookean;
  expect_derivatives({held}, {"skin.thickness", "skin.prestress_v", "tissue.young_modulus"},
                     Method::automatic, 1e-4);
}

/// Some pairs touch in every frame, others do not: the same ones at all steps of the differences.
TEST(Sensitivities, WhereLipsPressOnEachOther) {
  Parameters p = sheared();
  p.cut.contact = true;
  p.skin.prestress.uu = 0.05, p.skin.prestress.vv = 0.002;
  Parameters without = p;
  without.cut.contact = false;
  EXPECT_GT(difference(solved_alone(p), solved_alone(without)), 0.01);
  std::vector<std::string> names = of_the_stiffness;
  names.insert(names.end(), of_the_prestress.begin(), of_the_prestress.end());
  expect_derivatives({p}, names);
}

/// More frames than are solved together, and more loads of derivatives than are.
TEST(Sensitivities, OfManyFrames) {
  Parameters p = sheared();
  p.patch.length = 20, p.cut.length = 16, p.cut.depth = 3, p.patch.height = 4,
  p.cut.frames = FrameEvery::pair;
  p.patch.width = 4;
  Parameters q = p;
  q.skin.prestress.vv = 0.05;  // three loads a frame: 21 frames at a time
  expect_derivatives({p, q}, {"skin.young_modulus"});
}

}  // namespace cleft
