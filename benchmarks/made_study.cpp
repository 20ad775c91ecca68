#include "benchmarks/made_study.h"

#include <cmath>
#include <filesystem>
#include <random>

#include "base/output_file.h"
#include "base/sealed_json.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/unknowns.h"

namespace cleft {

namespace {

/// A case between: displacements follow powers of the tissue's modulus and of the prestress, and change their
/// shape over (u, v, w, t) along with the modulus and as random cases do.
Field varied(const Field& base, int number) {
  const double x = std::fmod(0.8191725134 * number, 1), y = std::fmod(0.6710436067 * number, 1);
  std::mt19937 random(static_cast<unsigned>(number));
  std::normal_distribution<double> normal;
  const double size = std::pow(4, -0.7 * (x - 0.5)) * (0.5 + y);
  double shape[4];
  for (double& s : shape) s = 0.1 * (x - 0.5) + 0.005 * normal(random);
  std::vector<Vec3> points = base.coefficients();
  const auto V = static_cast<std::size_t>(base.basis(1).size()),
             W = static_cast<std::size_t>(base.basis(2).size()),
             T = static_cast<std::size_t>(base.basis(3).size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    // The same left and right of the cut where the case is.
    const double across = double(n / (T * W) % V) / double(V - 1);
    const double at[] = {double(n / (T * W * V)) / base.basis(0).size(), std::abs(2 * across - 1),
                         double(n / T % W) / double(W), double(n % T) / double(T)};
    double factor = 1;
    for (int axis = 0; axis < 4; ++axis) factor += shape[axis] * std::sin(3 * at[axis] + axis);
    points[n] = size * factor * points[n];
  }
  Field field(base.shared_parametrization(), {base.basis(0), base.basis(1), base.basis(2), base.basis(3)},
              std::move(points));
  field.parameters = base.parameters, field.report = base.report;
  field.case_hash = "case" + std::to_string(100000 + number);
  RecordedParameters& p = field.parameters;
  p.set(p->tissue.young_modulus, p->tissue.young_modulus * std::pow(4, x - 0.5));
  p.set(p->skin.prestress.vv, p->skin.prestress.vv * (0.5 + y));
  field.report.largest_displacement *= size;
  // As tied control points as the given ones; neighbours of a step's size code alike.
  Field stepped = quantised(field, base.quantum * size, 0.625);
  return stepped;
}

}  // namespace

std::vector<StudyCase> make_study(const Field& base, const std::string& folder, int count) {
  std::vector<StudyCase> cases;
  for (int n = 0; n < count; ++n) {
    const Field field = varied(base, n);
    const std::string place = folder + "/cases/" + field.case_hash;
    std::filesystem::create_directories(place);
    write_field(place + "/case.dffd", field);
    write_text_file(
        place + "/manifest.json",
        sealed_text({{"format", "cleft-case"}, {"version", 2}, {"parameters", {{"cut.contact", "false"}}}}));
    cases.push_back({field.case_hash, place + "/case.dffd"});
    cases.back().choices.set("cut.contact", "false");
  }
  return cases;
}

}  // namespace cleft
