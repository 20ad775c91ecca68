// What a study of many cases costs on disk, to open, to list and to decode a case of.
// cleft-benchmark-study CASE.dffd FOLDER [CASES]: makes FOLDER a study of CASES cases (1,000) of the given
// one's knots and steps, whose parameters and control points differ, and its study.dffd, for cleft pack and
// cleft interpolate too.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <random>

#include "base/output_file.h"
#include "base/quantiles.h"
#include "base/sealed_json.h"
#include "base/stopwatch.h"
#include "encoder/field/field_file.h"
#include "encoder/field/study_file.h"
#include "encoder/field/unknowns.h"

using namespace cleft;
namespace fs = std::filesystem;

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
  field.parameters["tissue.young_modulus"] *= std::pow(4, x - 0.5);
  field.parameters["skin.prestress_v"] *= 0.5 + y;
  field.report.largest_displacement *= size;
  // As tied control points as the given ones; neighbours of a step's size code alike.
  Field stepped = quantised(field, base.quantum * size, 0.625);
  return stepped;
}

std::vector<StudyCase> make(const Field& base, const std::string& folder, int count) {
  std::vector<StudyCase> cases;
  for (int n = 0; n < count; ++n) {
    const Field field = varied(base, n);
    const std::string place = folder + "/cases/" + field.case_hash;
    fs::create_directories(place);
    write_field(place + "/case.dffd", field);
    write_text_file(
        place + "/manifest.json",
        sealed_text({{"format", "cleft-case"}, {"version", 2}, {"parameters", {{"cut.contact", "false"}}}}));
    cases.push_back({field.case_hash, place + "/case.dffd", {{"cut.contact", "false"}}});
  }
  return cases;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "cleft-benchmark-study CASE.dffd FOLDER [CASES]\n");
    return 2;
  }
  const std::string folder = argv[2], file = folder + "/study.dffd";
  const int count = argc > 3 ? std::atoi(argv[3]) : 1000;
  const Field base = read_field(argv[1]);
  Stopwatch watch;
  const auto records = study_records(make(base, folder, count));
  write_study(file, records);
  std::size_t coded = 0;
  for (const StudyRecord& one : records) coded += one.record.coefficients.size();
  std::printf("%d cases made in %.1f s: %.3f MB, coefficients %.3f MB\n", count, watch.seconds(),
              double(fs::file_size(file)) / 1e6, double(coded) / 1e6);

  std::vector<double> open, decode;
  for (int repeat = 0; repeat < 7; ++repeat) {
    watch = Stopwatch();
    const StudyFile study(file);
    double checked = 0;
    for (int i = 0; i < study.size(); ++i)
      checked += static_cast<double>(study.parameters(i).size() + study.case_hash(i).size()) +
                 study.report(i).node_error;
    open.push_back(watch.seconds());
    if (!(checked > 0)) return 1;
  }
  const StudyFile study(file);
  for (int i = 0; i < study.size(); i += std::max(1, study.size() / 200)) {
    const std::clock_t begin = std::clock();  // of this thread alone, whatever else the machine does
    const Field field = study.field(i);
    decode.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::printf(
      "open and list %.0f ms; decode a case, of the processor: median %.2f ms, least %.2f, most %.2f\n",
      1e3 * median(open), 1e3 * median(decode), 1e3 * quantile(decode, 0), 1e3 * quantile(decode, 1));
} catch (const std::exception& e) {
  std::fprintf(stderr, "cleft-benchmark-study: %s\n", e.what());
  return 1;
}
