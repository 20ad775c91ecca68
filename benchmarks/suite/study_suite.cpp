// A study of many cases: what running one takes beside solving and encoding, and what reading one takes.
#include <filesystem>
#include <sstream>

#include "base/process.h"
#include "base/text.h"
#include "benchmarks/made_study.h"
#include "benchmarks/suite/suite.h"

namespace cleft {

namespace {

/// By study_overhead.sh, which says "figure number" a line.
void run_study(benchmark::State& state) {
  const std::string cases = std::to_string(state.range(0)), folder = SuiteCase::get().folder,
                    log = folder + "/overhead.log", output = folder + "/overhead.txt";
  for (auto _ : state)
    if (!run_process({CLEFT_BENCHMARKS "/study_overhead.sh", cases, executable_folder()}, log, {}, nullptr,
                     output)
             .success())
      return state.SkipWithError(read_text_file(log).c_str());
  std::istringstream lines(read_text_file(output));
  std::string figure;
  for (double number; lines >> figure >> number;) state.counters[figure] = number;
}
BENCHMARK(run_study)->Arg(100)->Iterations(1)->Unit(benchmark::kMillisecond);

/// A study.dffd of many cases, made once.
const std::string& made_study(std::int64_t cases) {
  static const std::string file = [&] {
    const std::string folder = SuiteCase::get().folder + "/study";
    std::filesystem::create_directories(folder);
    write_study(folder + "/study.dffd",
                study_records(make_study(SuiteCase::get().field, folder, static_cast<int>(cases))));
    return folder + "/study.dffd";
  }();
  return file;
}

void open_and_list_study(benchmark::State& state) {
  const std::string& file = made_study(state.range(0));
  {
    const WorkCount count(state);
    for (auto _ : state) {
      const StudyFile study(file);
      for (int i = 0; i < study.size(); ++i)
        benchmark::DoNotOptimize(static_cast<double>(study.parameters(i).empty()) +
                                 study.report(i).node_error);
    }
  }
  state.counters["work_bytes"] = static_cast<double>(std::filesystem::file_size(file));
}
BENCHMARK(open_and_list_study)->Arg(1000)->Unit(benchmark::kMillisecond);

void decode_case_of_study(benchmark::State& state) {
  const StudyFile study(made_study(state.range(0)));
  const WorkCount count(state);
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(study.field(i++ % study.size()).coefficients().data());
}
BENCHMARK(decode_case_of_study)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace cleft
