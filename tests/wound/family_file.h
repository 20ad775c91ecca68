// A family of fields made up for tests, whose displacements follow a formula of the shape.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "tests/support/temporary_folder.h"

namespace cleft::testing {

struct MadeShape {
  double curvature = 0, twist = 0, depth = 3;
  double length = 20;  ///< of the cut
  double slope = 3;    ///< by which displacements grow with the curvature, mm
  double along = 1;    ///< what the prestress along the cut moves, over what it moves by default
  double rate = 0;     ///< cut.curvature_rate
  double bone = 0;     ///< how deep it is, mm; 0: none
};

/// A small field that opens by a millimetre or so, (1 + slope curvature + 20 curvature^2 + 10 twist + 100
/// rate) depth / 3 times one, bone / 10 times that on bone, that is linear in the prestress; its w is that of
/// the cut's depth.
inline Field made(const MadeShape& shape, const Prestress& sigma) {
  constexpr double unit = 0.01;  // MPa
  const double length = shape.length;
  const BSplineBasis u = BSplineBasis::uniform(3, 20, -30, 30), v = BSplineBasis::broken(3, 8, -20, 0, 20),
                     w = BSplineBasis::uniform(3, 5, shape.bone > 0 ? -shape.bone : -8, 0),
                     t = BSplineBasis::uniform(3, 8, 0, length);
  const double size = (1 + shape.slope * shape.curvature + 20 * shape.curvature * shape.curvature +
                       10 * shape.twist + 100 * shape.rate) *
                      (shape.bone > 0 ? shape.bone / 10 : 1) * shape.depth / 3 / unit / 100;
  const auto greville = [](const BSplineBasis& b, int i) {
    return (b.knots()[i + 1] + b.knots()[i + 2] + b.knots()[i + 3]) / 3;
  };
  std::vector<Vec3> c;
  for (int i = 0; i < u.size(); ++i)
    for (int j = 0; j < v.size(); ++j)
      for (int k = 0; k < w.size(); ++k)
        for (int l = 0; l < t.size(); ++l) {
          const double x = greville(u, i) + length / 2, side = j < v.size() / 2 ? -1 : 1;
          const double open = std::sqrt(std::max(0., x * (greville(t, l) - x)));
          const double g = size * open * std::exp(-0.1 * std::abs(greville(v, j))) * (k + 1) / 5.;
          c.push_back({g * (shape.along * sigma.uu + 0.2 * sigma.vv), g * side * sigma.vv,
                       g * (0.3 * sigma.uv + 0.1 * sigma.vv)});
        }
  Field field(u, v, w, t, std::move(c), {-length / 2, length, shape.depth});
  Parameters p;
  p.patch.length = 60, p.patch.width = 40, p.cut.length = length, p.cut.depth = shape.depth;
  p.skin.prestress = sigma;
  field.parameters = RecordedParameters(p);
  field.parameters.set("cut.curvature", shape.curvature);
  field.parameters.set("cut.curvature_rate", shape.rate);
  if (shape.bone > 0) {
    field.parameters.set("patch.bottom", std::string("bone"));
    field.parameters.set("patch.height", shape.bone);
  }
  field.parameters.set("skin.curvature_uv", shape.twist);
  field.report.spline_error = 1e-6;
  field.report.largest_displacement = 0.1;
  return field;
}

/// A study.dffd of a family.
class FamilyFile {
 public:
  struct Options {
    bool with_twist = true, with_shear = true;
    double length = 20, slope = 3, along = 1;
    bool with_rate_and_bone = false;  ///< in place of twists and depths
  };

  explicit FamilyFile(const Options& options) {
    if (options.with_rate_and_bone) {
      write_rates_and_bones(options.length);
      return;
    }
    std::vector<StudyCase> cases;
    for (const double curvature : {-0.1, -0.05, 0., 0.05, 0.1})
      for (const double twist : {-0.03, 0., 0.03})
        for (const double depth : {2., 3., 4.})
          for (const Prestress& sigma : {Prestress{0.01, 0, 0}, {0, 0.01, 0}, {0.01, 0.01, 0.005}}) {
            if (!options.with_twist && twist != 0) continue;
            if (!options.with_shear && sigma.uv != 0) continue;
            const std::string name = "case" + std::to_string(cases.size());
            write_field(folder_ / (name + ".dffd"),
                        made({curvature, twist, depth, options.length, options.slope, options.along}, sigma));
            cases.push_back({name, folder_ / (name + ".dffd"), {}});
          }
    write_study(file(), study_records(cases));
  }

  std::string file() const { return folder_ / "study.dffd"; }

 private:
  void write_rates_and_bones(double length) {
    std::vector<MadeShape> shapes;
    for (const double curvature : {-0.03, 0., 0.03})
      for (const double rate : {-0.003, 0., 0.003})
        shapes.push_back({.curvature = curvature, .length = length, .rate = rate});
    for (const double bone : {5., 6.5, 8.}) shapes.push_back({.length = length, .bone = bone});
    std::vector<StudyCase> cases;
    for (const MadeShape& shape : shapes)
      for (const Prestress& sigma : {Prestress{0.01, 0, 0}, {0, 0.01, 0}, {0.01, 0.01, 0.005}}) {
        const std::string name = "case" + std::to_string(cases.size());
        write_field(folder_ / (name + ".dffd"), made(shape, sigma));
        cases.push_back({name, folder_ / (name + ".dffd"), {}});
      }
    write_study(file(), study_records(cases));
  }

  TemporaryFolder folder_;
};

}  // namespace cleft::testing
