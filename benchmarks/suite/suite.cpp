#include "benchmarks/suite/suite.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/output_file.h"
#include "base/quantiles.h"
#include "encoder/field/file/field_file.h"
#include "tests/support/allocations.h"
#include "tests/support/temporary_folder.h"
#include "tradeoff/tool.h"

namespace cleft {

namespace {

std::string made(const std::string& folder) {
  write_text_file(folder + "/case.toml", "[case]\nmesh.element_size = 1.5\n");
  run_tool("solve", {folder + "/case.toml", "--out", folder + "/case.h5"}, folder);
  run_tool("encode", {folder + "/case.h5", "--out", folder + "/case.dffd"}, folder);
  return folder;
}

}  // namespace

SuiteCase::SuiteCase(std::string folder_path)
    : folder(std::move(folder_path)),
      study_file(folder + "/case.toml"),
      snapshot(folder + "/case.h5"),
      field_file(folder + "/case.dffd"),
      series(SnapshotReader(snapshot)),
      field(read_field(field_file)) {}

const SuiteCase& SuiteCase::get() {
  static const TemporaryFolder temporary;
  static const SuiteCase one(made(temporary.path()));
  return one;
}

WorkCount::WorkCount(benchmark::State& state) : state_(state), allocations_(allocations()) {
  perf_event_attr what{};
  what.type = PERF_TYPE_HARDWARE, what.size = sizeof(what), what.config = PERF_COUNT_HW_INSTRUCTIONS;
  what.exclude_kernel = what.exclude_hv = 1, what.inherit = 1;
  file_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
}

WorkCount::~WorkCount() {
  const auto iterations = static_cast<double>(state_.iterations());
  state_.counters["work_allocations"] = static_cast<double>(allocations() - allocations_) / iterations;
  if (file_ < 0) return;
  long long instructions = 0;
  if (read(file_, &instructions, sizeof(instructions)) == sizeof(instructions))
    state_.counters["work_instructions"] = static_cast<double>(instructions) / iterations;
  close(file_);
}

void report_quantiles(benchmark::State& state, const std::string& prefix,
                      const std::vector<double>& samples) {
  state.counters[prefix + "_p50"] = quantile(samples, 0.5);
  state.counters[prefix + "_p99"] = quantile(samples, 0.99);
  state.counters[prefix + "_p99_9"] = quantile(samples, 0.999);
}

}  // namespace cleft
