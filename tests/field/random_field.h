// A field with random control points, the same at every call.
#pragma once

#include <random>

#include "encoder/field/field.h"
#include "encoder/field/unknowns.h"

namespace cleft {

inline Field random_field() {
  const BSplineBasis u = BSplineBasis::uniform(3, 7, -30, 30), v = BSplineBasis::broken(3, 10, -20, 0, 20),
                     w = BSplineBasis::uniform(3, 5, -8, 0), t = BSplineBasis::uniform(3, 6, 0, 24);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);  // floats: what a file stores
  std::vector<Vec3> coefficients(7 * 10 * 5 * 6);
  for (Vec3& c : coefficients) c = {uniform(random), uniform(random), uniform(random)};
  Field field(u, v, w, t, coefficients, {-12, 24, 3});
  field.parameters = {{"tissue.young_modulus", 0.02}, {"skin.thickness", 1.5}};
  field.case_hash = "0123456789abcdef";
  field.report.node_error = 0.0625;
  return field;
}

/// A field that follows the tip, with knots, path, parameters and report as an encoded case has them, whose
/// unknowns are multiples of its quantum. `variant` changes parameters, figures and coefficients.
inline Field following_field(int variant = 0) {
  const auto graded = [](std::vector<double> ends, int spans) {
    std::vector<double> knots;
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
      const bool outer = part == 0;
      knots.insert(knots.end(), outer ? 4 : 3, ends[part]);
      for (int s = 1; s < spans; ++s) {
        const double x = static_cast<double>(s) / spans;
        knots.push_back(ends[part] + x * x * (ends[part + 1] - ends[part]));
      }
    }
    knots.insert(knots.end(), 4, ends.back());
    return BSplineBasis(3, knots);
  };
  std::array<BSplineBasis, 4> bases{graded({0, 1, 2, 3}, 4), BSplineBasis::broken(3, 14, -1, 0, 1),
                                    graded({-2, -1, 0}, 2), BSplineBasis::uniform(3, 13, 0, 1)};
  FieldGeometry geometry{{{{-60, 60}, {-40, 40}, {-15, 0}, {0, 41.3}}}, {-20.7, 41.3, 4.9}, {}};
  for (int frame = 0; frame < 48; ++frame) {
    geometry.tip.times.push_back(41.3 * frame / 47);
    geometry.tip.positions.push_back(-20.7 + 41.3 * frame / 47 * (1 + 1e-9 * frame));
  }
  std::size_t count = 1;
  for (const BSplineBasis& b : bases) count *= static_cast<std::size_t>(b.size());
  std::mt19937 random(static_cast<unsigned>(variant) + 1);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points(count);
  const std::size_t T = static_cast<std::size_t>(bases[3].size());
  for (std::size_t place = 0; place < count / T; ++place) {
    const Vec3 last{normal(random), normal(random), normal(random)};
    for (std::size_t l = 1; l < T; ++l) points[place * T + l] = static_cast<double>(l) / (T - 1) * last;
  }
  Field field(make_parametrization("tip", geometry), bases, points);
  const char* names[] = {"cut.count",
                         "cut.depth",
                         "cut.length",
                         "cut.radius",
                         "cut.spacing",
                         "foundation.side_stiffness",
                         "foundation.stiffness",
                         "mesh.cut_depth",
                         "mesh.cut_length",
                         "mesh.element_size",
                         "mesh.grading",
                         "patch.height",
                         "patch.length",
                         "patch.width",
                         "skin.poisson_ratio",
                         "skin.prestress_u",
                         "skin.prestress_uv",
                         "skin.prestress_v",
                         "skin.thickness",
                         "skin.young_modulus",
                         "tissue.poisson_ratio",
                         "tissue.young_modulus"};
  double value = 1;
  for (const char* name : names) field.parameters[name] = value /= 1.7;
  field.parameters["skin.prestress_v"] = 0.01 + 0.001 * (variant % 40);
  field.parameters["tissue.young_modulus"] = 0.01 + 0.0003 * (variant / 40);
  for (int n = 0; n < 64; ++n) field.case_hash += "0123456789abcdef"[random() % 16];
  std::uniform_real_distribution<double> figure(0.001, 0.02);
  FitReport& r = field.report;
  for (double* x : {&r.relative_l2, &r.node_error, &r.spline_error, &r.gape_error, &r.false_gap})
    *x = figure(random);
  r.largest_displacement = 100 * figure(random);
  return quantised(field, 0.01, 0.5);
}

}  // namespace cleft
