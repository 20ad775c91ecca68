#include "params/stiffness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "params/material/isotropic.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

std::string text_of_all(const Parameters& p) {
  std::string key;
  for (const Parameter& row : parameter_table()) key += to_text(get_parameter(p, row)) + ";";
  return key;
}

/// The one thing in a mesh that a modulus tells.
std::string diagonals_of(const Parameters& p) { return has_chess_board(p) ? "chess board" : ""; }

}  // namespace

std::string stiffness_key(Parameters p) {
  const Parameters defaults;
  if (p.model == Model::small) {
    if (!is_stiffened_by_prestress(p)) p.skin.prestress = {};
    p.skin.law = defaults.skin.law, p.skin.stiffening = defaults.skin.stiffening;
    p.skin.fibre_share = defaults.skin.fibre_share, p.skin.fibre_angle = defaults.skin.fibre_angle;
    p.skin.fibre_dispersion = defaults.skin.fibre_dispersion, p.tissue.law = defaults.tissue.law;
  }
  if (p.mesh.cut_length == 0) p.mesh.cut_length = p.cut.length;
  if (p.mesh.cut_depth == 0) p.mesh.cut_depth = p.cut.depth;
  p.cut.length = defaults.cut.length, p.cut.depth = defaults.cut.depth;
  p.cut.frames = defaults.cut.frames, p.cut.contact = defaults.cut.contact;
  return text_of_all(p);
}

Parameters with_moduli_of(const Parameters& parameters, const Parameters& other) {
  Parameters p = parameters;
  p.skin.thickness = other.skin.thickness, p.skin.young_modulus = other.skin.young_modulus;
  p.skin.poisson_ratio = other.skin.poisson_ratio, p.skin.bending_stiffness = other.skin.bending_stiffness;
  p.tissue.young_modulus = other.tissue.young_modulus, p.tissue.poisson_ratio = other.tissue.poisson_ratio;
  p.foundation = other.foundation;
  return p;
}

std::string mesh_key(const Parameters& p) {
  return stiffness_key(with_moduli_of(p, Parameters())) + diagonals_of(p);
}

std::string pattern_key(const Parameters& p) {
  return mesh_key(p) + (p.skin.bending_stiffness > 0 ? "bends" : "");
}

std::string mesh_and_release_key(Parameters p) {
  const Parameters defaults;
  const std::string diagonals = diagonals_of(p);
  p = with_moduli_of(p, defaults);
  p.skin.prestress = defaults.skin.prestress, p.tissue.prestress_share = defaults.tissue.prestress_share;
  return text_of_all(p) + diagonals;
}

StiffnessRatios stiffness_ratios(const Parameters& one, const Parameters& other) {
  const auto moduli = [](const Parameters& p) {
    const Isotropic tissue(p.tissue.young_modulus, p.tissue.poisson_ratio);
    const double sheet = p.skin.thickness * p.skin.young_modulus, nu = p.skin.poisson_ratio;
    // The springs of bone are multiples of Young's modulus, whose ratio is between those of these two.
    return std::array{tissue.shear,
                      tissue.bulk,
                      sheet / (1 + nu),
                      sheet / (1 - nu),
                      p.skin.bending_stiffness,
                      p.foundation.stiffness,
                      p.foundation.side_stiffness};
  };
  StiffnessRatios ratios{HUGE_VAL, 0};
  const auto a = moduli(one), b = moduli(other);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == 0 && b[i] == 0) continue;
    const double ratio = b[i] == 0 ? HUGE_VAL : a[i] / b[i];
    ratios = {std::min(ratios.least, ratio), std::max(ratios.greatest, ratio)};
  }
  return ratios;
}

PrestressSetting prestress_setting(const Parameters& p) {
  if (p.skin.turning_stiffness > 0)
    return {row_of(p, p.skin.turning_stiffness).name + " = " + shortest(p.skin.turning_stiffness), "0"};
  return {row_of(p, p.skin.initial_stress_stiffness).name + " = true", "false"};
}

void check_linear(const Parameters& p, const std::string& where) {
  const auto refuse = [&](const std::string& setting, const std::string& why, const std::string& remedy) {
    throw InputError(where + ": " + setting + ": " + why + "; " + remedy);
  };
  const std::string solve = "solve the case (cleft solve) and compare";
  if (p.model == Model::finite)
    refuse(row_of(p, p.model).name + " = finite", "the bound is one of linear equations", solve);
  if (p.cut.contact)
    refuse(row_of(p, p.cut.contact).name + " = true", "forces of contact are not known without solving",
           solve + ", or set it to false");
  if (is_stiffened_by_prestress(p))
    refuse(prestress_setting(p).text,
           "the stiffness may have negative parts, so that no ratio of moduli bounds it", solve);
}

}  // namespace cleft
