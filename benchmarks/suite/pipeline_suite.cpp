// From parameters to a field.
#include "benchmarks/suite/suite.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_record.h"
#include "tradeoff/tool.h"

namespace cleft {

namespace {

void solve(benchmark::State& state) {
  const SuiteCase& one = SuiteCase::get();
  nlohmann::json figures;
  for (auto _ : state) {
    figures = run_tool("solve", {one.study_file, "--out", one.folder + "/again.h5"}, one.folder);
    state.SetIterationTime(total_seconds(figures));
  }
  state.counters["work_unknowns"] = figures.at("unknowns").get<double>();
}
BENCHMARK(solve)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

void encode_case(benchmark::State& state, const std::string& parametrization, double tolerance) {
  const SuiteCase& one = SuiteCase::get();
  EncodeOptions options;
  options.parametrization = parametrization, options.tolerance = tolerance;
  double bytes = 0;
  FitReport report;
  for (auto _ : state) {
    const auto [field, residual, of_quantities] = encode(one.series, options, [](const std::string&) {});
    bytes = static_cast<double>(record_of(field).coefficients.size());
    if (residual) bytes += static_cast<double>(residual->bytes());
    report = field.report;
  }
  state.counters["work_bytes"] = bytes;
  state.counters["error_node"] = report.node_error;
  state.counters["error_l2"] = report.relative_l2;
}
BENCHMARK_CAPTURE(encode_case, tip_4_2_percent, "tip", 0.042)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encode_case, tip_1_1_percent, "tip", 0.011)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encode_case, fixed_1_1_percent, "fixed", 0.011)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace cleft
