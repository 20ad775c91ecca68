// Our encoder next to others on one snapshot: bytes at equal errors, times, and errors where no node is.
// cleft-benchmark-encoder CASE.h5 [TOLERANCE...]: default 0.042 0.017 0.011 0.001.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <random>

#include "base/stopwatch.h"
#include "benchmarks/encoder/ours.h"
#include "benchmarks/encoder/pod_rival.h"
#include "tradeoff/rivals/node_data.h"
#include "tradeoff/rivals/zfp_rival.h"

using namespace cleft;

namespace {

void print_ours(const std::vector<double>& tolerances, const std::vector<OurRun>& runs, double raw) {
  std::printf("\n%9s %12s %9s %10s %8s %10s %11s %9s %8s %5s %8s %7s %8s %7s %8s\n", "tolerance",
              "coefficients", "residual", "file", "ratio", "node error", "relative L2", "centroids", "unseen",
              "frame", "later", "fit", "verify", "write", "peak");
  std::printf("%9s %12s %9s %10s %8s %10s %11s %9s %8s %5s %8s %7s %8s %7s %8s\n", "", "bytes", "bytes",
              "bytes", "", "", "", "", "frames", "", "", "s", "s", "s", "GB");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const OurRun& r = runs[i];
    std::printf(
        "%9g %12.0f %9.0f %10.0f %8.1f %10.5f %11.6f %9.5f %8.5f %5zu %8.5f %7.1f %8.2f %7.3f %8.2f\n",
        tolerances[i], r.coefficient_bytes, r.residual_bytes, r.file_bytes, raw / r.file_bytes,
        r.errors.node_error, r.errors.relative_l2, r.centroid_error, r.unseen_error, r.unseen_frame,
        r.later_error, r.fit, r.verify, r.write, r.peak_bytes / 1e9);
  }
}

void print_row(const char* name, const Compressed& c, double ours, double raw) {
  std::printf("  %-22s %12.0f %9.1f %9.1f   %8.5f %10.6f   %s\n", name, c.bytes, raw / c.bytes,
              c.bytes / ours, c.errors.node_error, c.errors.relative_l2, c.how.c_str());
}

class Comparison {
 public:
  Comparison(const Series& series, const NodeData& data)
      : series_(series), data_(data), pod_(data), in_file_order_(data.nodes) {
    std::iota(in_file_order_.begin(), in_file_order_.end(), 0);
    shuffled_ = in_file_order_;
    std::shuffle(shuffled_.begin(), shuffled_.end(), std::mt19937(1));
  }

  void print(const OurRun& ours, Goal goal) const {
    const double limit = of(ours.errors, goal), raw = data_.raw_bytes();
    std::printf("\nequal %s: %.6f\n", goal == Goal::node_error ? "largest error" : "relative L2", limit);
    std::printf("  %-22s %12s %9s %9s   %8s %10s\n", "", "bytes", "ratio", "x ours", "node", "L2");
    print_row("cleft", {ours.file_bytes, ours.errors, "the whole file"}, ours.file_bytes, raw);
    if (zfp_is_there()) {
      print_row("zfp, file order", zfp_within(data_, in_file_order_, goal, limit), ours.file_bytes, raw);
      print_row("zfp, shuffled", zfp_within(data_, shuffled_, goal, limit), ours.file_bytes, raw);
      if (const auto c = decimated_within(data_, series_.samples, goal, limit))
        print_row("decimated mesh, zfp", *c, ours.file_bytes, raw);
      else
        std::printf("  %-22s not reached with every 2nd node and nearest neighbours\n",
                    "decimated mesh, zfp");
    }
    print_row("POD", pod_.within(goal, limit), ours.file_bytes, raw);
    std::fflush(stdout);
  }

 private:
  const Series& series_;
  const NodeData& data_;
  Pod pod_;
  std::vector<int> in_file_order_, shuffled_;
};

void run(const std::string& file, const std::vector<double>& tolerances) {
  Stopwatch watch;
  const SnapshotReader reader(file);
  const Series series(reader);
  const NodeData data(series);
  std::printf("%s: %zu nodes, %zu frames, %.0f bytes as 32-bit floats; read in %.2f s\n", file.c_str(),
              data.nodes, data.frames + 1, data.raw_bytes(), watch.lap());
  std::printf("errors are over the largest displacement, %.4f mm; peak memory is that so far\n",
              data.largest);
  if (!zfp_is_there()) std::printf("built without zfp (Debian's libzfp-dev): its rows are left out\n");
  std::vector<OurRun> ours;
  for (const double tolerance : tolerances)
    ours.push_back(run_ours(series, reader.snapshot(), data, tolerance));
  print_ours(tolerances, ours, data.raw_bytes());
  const Comparison comparison(series, data);
  for (const OurRun& one : ours)
    for (const Goal goal : {Goal::node_error, Goal::relative_l2}) comparison.print(one, goal);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: cleft-benchmark-encoder CASE.h5 [TOLERANCE...]\n");
    return 2;
  }
  std::vector<double> tolerances;
  for (int i = 2; i < argc; ++i) tolerances.push_back(std::atof(argv[i]));
  if (tolerances.empty()) tolerances = {0.042, 0.017, 0.011, 0.001};
  try {
    run(argv[1], tolerances);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cleft-benchmark-encoder: error: %s\n", e.what());
    return 1;
  }
}
