// What a study of many cases costs on disk, to open, to list and to decode a case of.
// cleft-benchmark-study CASE.dffd FOLDER [CASES]: makes FOLDER a study of CASES cases (1,000) of the given
// one's knots and steps, whose parameters and control points differ, and its study.dffd, for cleft pack and
// cleft interpolate too.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "benchmarks/made_study.h"
#include "encoder/field/file/field_file.h"

using namespace cleft;
namespace fs = std::filesystem;

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "cleft-benchmark-study CASE.dffd FOLDER [CASES]\n");
    return 2;
  }
  const std::string folder = argv[2], file = folder + "/study.dffd";
  const int count = argc > 3 ? std::atoi(argv[3]) : 1000;
  const Field base = read_field(argv[1]);
  Stopwatch watch;
  const auto records = study_records(make_study(base, folder, count));
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
      checked += static_cast<double>(study.parameters(i).empty() + study.case_hash(i).size()) +
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
