// cleft-benchmark-places CASE.dffd [REPEATS]: nanoseconds for each of 10^6 places of the skin, row after row,
// by one thread: the C++ call that benchmarks/python_benchmark.py compares the Python module with.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "encoder/field/file/field_file.h"

int main(int argc, char** argv) {
  using namespace cleft;
  if (argc < 2) return std::fprintf(stderr, "cleft-benchmark-places CASE.dffd [REPEATS]\n"), 2;
  try {
    const Field field = read_field(argv[1]);
    constexpr int rows = 1000;
    const auto at = [](const Interval& range, int i) {
      return range.front + (range.back - range.front) * i / (rows - 1);
    };
    std::vector<Place> places;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j)
        places.push_back(
            {{at(field.domain(0), j), at(field.domain(1), i), 0}, Side::both, field.duration() / 2});
    std::vector<Vec3> out(places.size());
    std::vector<double> times;
    for (int repeat = 0; repeat < (argc > 2 ? std::atoi(argv[2]) : 7); ++repeat) {
      const Stopwatch watch;
      field.displacements(places, out);
      times.push_back(1e9 * watch.seconds() / static_cast<double>(places.size()));
    }
    std::printf("%.2f\n", median(times));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cleft-benchmark-places: %s\n", e.what());
    return 1;
  }
}
