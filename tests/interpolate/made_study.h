// A study whose displacements follow a formula, so that what lies between its cases is known.
#pragma once

#include <cmath>

#include "encoder/field/knot_insertion.h"
#include "encoder/interpolate/common_cases.h"
#include "tests/field/random_field.h"
#include "tests/support/recorded.h"

namespace cleft {

using CaseParameters = std::map<std::string, double>;

/// All that the solver is told, with the given values changed.
inline CaseParameters parameters_with(const CaseParameters& values) {
  CaseParameters all = {{"patch.length", 60},
                        {"patch.width", 40},
                        {"patch.height", 8},
                        {"cut.length", 24},
                        {"cut.depth", 3},
                        {"cut.radius", 0},
                        {"mesh.element_size", 1},
                        {"mesh.grading", 1},
                        {"mesh.cut_length", 0},
                        {"mesh.cut_depth", 0},
                        {"skin.thickness", 1.5},
                        {"skin.young_modulus", 0.13},
                        {"skin.poisson_ratio", 0.4},
                        {"skin.prestress_u", 0.01},
                        {"skin.prestress_v", 0.03},
                        {"skin.prestress_uv", 0},
                        {"tissue.young_modulus", 0.02},
                        {"tissue.poisson_ratio", 0.4},
                        {"foundation.stiffness", 0.005},
                        {"foundation.side_stiffness", 0.005}};
  for (const auto& [name, value] : values) all[name] = value;
  return all;
}

inline FieldGeometry geometry_with(const CaseParameters& p) {
  const double l = p.at("cut.length");
  return {{{{-p.at("patch.length") / 2, p.at("patch.length") / 2},
            {-p.at("patch.width") / 2, p.at("patch.width") / 2},
            {-p.at("patch.height"), 0},
            {0, l}}},
          {-l / 2, l, p.at("cut.depth")},
          {{0, l}, {-l / 2, l / 2}}};
}

/// Random control points with nothing at t = 0.
inline std::vector<Vec3> random_motion(unsigned seed) {
  const auto bases = tip_bases();
  std::vector<Vec3> points = random_coefficients(bases, seed);
  const std::size_t T = bases[3].size();
  for (std::size_t n = 0; n < points.size(); n += T) points[n] = {};
  return points;
}

/// (q_v (M0 s^-0.4 + M1 depth / L) + q_u M2 s^-0.2) / E, q the prestress times the thickness t, s = E_s t /
/// (E L).
inline std::vector<Vec3> made_points(const CaseParameters& p) {
  static const std::vector<Vec3> motion[] = {random_motion(1), random_motion(2), random_motion(3)};
  const double E = p.at("tissue.young_modulus"), L = p.at("cut.length"), t = p.at("skin.thickness");
  const double s = p.at("skin.young_modulus") * t / (E * L);
  const double v = p.at("skin.prestress_v") * t / E, u = p.at("skin.prestress_u") * t / E;
  std::vector<Vec3> points(motion[0].size());
  for (std::size_t n = 0; n < points.size(); ++n)
    points[n] = v * (std::pow(s, -0.4) * motion[0][n] + p.at("cut.depth") / L * motion[1][n]) +
                u * std::pow(s, -0.2) * motion[2][n];
  return points;
}

inline Field made_field(const CaseParameters& values) {
  const CaseParameters p = parameters_with(values);
  Field field(make_parametrization("tip", geometry_with(p)), tip_bases(), made_points(p));
  field.parameters = recorded(p), field.report.spline_error = 1e-6;
  return field;
}

/// With its derivative by a parameter.
inline Field with_derivative(Field field, const std::string& name) {
  const double value = field.parameters.number(name).value(), step = 1e-5 * value;
  CaseParameters less = field.parameters.numbers(), more = less;
  less[name] -= step, more[name] += step;
  const std::vector<Vec3> a = made_points(less), b = made_points(more);
  ParameterDerivative& one = field.by_parameter.emplace_back();
  one.parameter = name, one.error = 1e-6, one.largest = 1 / value;
  for (std::size_t n = 0; n < a.size(); ++n) one.control_points.push_back((1 / (2 * step)) * (b[n] - a[n]));
  return field;
}

/// On finer knots along one axis.
inline Field finer(const Field& field, int axis, double knot) {
  std::array<BSplineBasis, 4> from = tip_bases(), to = from;
  std::vector<double> knots = from[axis].knots();
  knots.insert(std::upper_bound(knots.begin(), knots.end(), knot), knot);
  to[axis] = BSplineBasis(3, knots);
  Field result(field.shared_parametrization(), to, insert_knots(field.coefficients(), from, to));
  result.parameters = field.parameters, result.report = field.report,
  result.by_parameter = field.by_parameter;
  for (ParameterDerivative& one : result.by_parameter)
    one.control_points = insert_knots(one.control_points, from, to);
  return result;
}

/// Cases of these values; every third of another rung, along another axis.
inline std::vector<StudyMember> made_study(const std::vector<CaseParameters>& list) {
  std::vector<StudyMember> members;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Field field = made_field(list[i]);
    Field own = i % 3 == 1 ? finer(field, 0, 1.5) : i % 3 == 2 ? finer(field, 2, -0.7) : field;
    own.parameters.set("cut.contact", "false");
    members.push_back({"case" + std::to_string(i), own});
  }
  return members;
}

/// Largest distance over the places, over the largest displacement there.
inline double distance_of(const Field& a, const Field& b, const std::vector<Place>& places) {
  double error = 0, largest = 0;
  for (const Place& place : places) {
    const Vec3 truth = b.displacement(place.uvw, place.side, place.t);
    error = std::max(error, norm(a.displacement(place.uvw, place.side, place.t) - truth));
    largest = std::max(largest, norm(truth));
  }
  return error / largest;
}

inline double distance_of(const Field& a, const Field& b) {
  return distance_of(a, b, all_kinds_of_places(b, 2000));
}

/// Nodes of elements of 1 mm, as parameters_with() has them, at frames for every third column.
inline std::vector<Place> nodes_of_millimetres() {
  std::vector<Place> places;
  for (int t = 3; t <= 24; t += 3)
    for (int u = -30; u <= 30; ++u)
      for (int v = -20; v <= 20; v += 2)
        for (int w = -8; w <= 0; ++w)
          for (const Side side : {Side::left, Side::right})
            if (v == 0 || side == Side::left)
              places.push_back({{1. * u, 1. * v, 1. * w}, v == 0 ? side : side_of(v), 1. * t});
  return places;
}

}  // namespace cleft
