// What the benchmarks of the suite share: one case, solved and encoded once, and counts of work.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/series.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The default case with elements of 1.5 mm, made on first use in a folder that goes with the program.
class SuiteCase {
 public:
  static const SuiteCase& get();

  std::string folder, study_file, snapshot, field_file;
  Series series;
  Field field;  ///< tip, tolerance 0.01

 private:
  SuiteCase(std::string folder_path);
};

/// Adds what was counted between its beginning and its end, over the iterations: allocations and, where the
/// kernel lets this process count them, instructions. Work, unlike time, hardly depends on what else runs.
class WorkCount {
 public:
  explicit WorkCount(benchmark::State& state);
  ~WorkCount();

 private:
  benchmark::State& state_;
  std::size_t allocations_;
  int file_ = -1;
};

/// p50, p99 and p99.9 of samples as counters of these names with a prefix.
void report_quantiles(benchmark::State& state, const std::string& prefix, const std::vector<double>& samples);

}  // namespace cleft
