// Evaluation, contraction, replay and decoding of a field.
#include <random>

#include "benchmarks/suite/suite.h"
#include "encoder/field/file/field_file.h"
#include "tradeoff/replays/frame_time.h"

namespace cleft {

namespace {

constexpr std::size_t points = 4096;

std::vector<Place> places(bool coherent) {
  const Field& field = SuiteCase::get().field;
  std::mt19937 random(1);
  const auto drawn = [&](int axis) {
    return std::uniform_real_distribution<double>(field.domain(axis).front, field.domain(axis).back)(random);
  };
  std::vector<Place> all;
  const auto part = [](std::size_t i) { return static_cast<double>(i % points) / points; };
  const double t = drawn(3);
  for (std::size_t i = 0; i < points; ++i) {
    Vec3 at{drawn(0), drawn(1), drawn(2)};
    const Interval& u = field.domain(0);
    if (coherent) at = {u.front + (u.back - u.front) * part(i), 2 + 0.1 * part(i), -1};
    all.push_back({at, at.y < 0 ? Side::left : Side::right, coherent ? t : drawn(3)});
  }
  return all;
}

void evaluate(benchmark::State& state, bool coherent) {
  const Field& field = SuiteCase::get().field;
  const std::vector<Place> at = places(coherent);
  std::vector<Vec3> out(at.size());
  {
    const WorkCount count(state);
    for (auto _ : state) {
      field.displacements(at, out);
      benchmark::DoNotOptimize(out.data());
    }
  }
  state.counters["ns_a_point"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * points * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(evaluate, coherent, true);
BENCHMARK_CAPTURE(evaluate, random, false);

void contract(benchmark::State& state) {
  const Field& field = SuiteCase::get().field;
  const std::vector<Place> at = places(false);
  History history;
  std::size_t i = 0;
  const WorkCount count(state);
  for (auto _ : state) {
    field.contract(at[i % points].uvw, at[i % points].side, field.contraction_tolerance(), history);
    ++i;
  }
}
BENCHMARK(contract);

void replay_frame_of_10000(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(frame_seconds(SuiteCase::get().field));
}
BENCHMARK(replay_frame_of_10000)->UseManualTime()->Iterations(5);

void read_case(benchmark::State& state) {
  const std::string& file = SuiteCase::get().field_file;
  const WorkCount count(state);
  for (auto _ : state) benchmark::DoNotOptimize(read_field(file).coefficients().data());
}
BENCHMARK(read_case);

}  // namespace

}  // namespace cleft
