// A snapshot of many nodes.
#pragma once

#include <optional>

#include "tests/encoder/synthetic_snapshot.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

/// 20,000 nodes of an imported series with a temperature.
class FineSnapshot {
 public:
  FineSnapshot() {
    Snapshot s = cut_in(grid(48, 40, 9), eight_times);
    s.source = SnapshotSource{"series.pvd", {}, same_axes, 0, "0,1,0,0"};
    s.residual_equilibrium.clear(), s.residual_closure.clear();
    const SnapshotArray array{"T", 1, true};
    SnapshotWriter writer(folder_ / "case.h5", s, {array});
    const std::vector<Sample> samples = samples_of(s);
    for (std::size_t j = 0; j < s.frames(); ++j) {
      std::vector<Vec3> d;
      std::vector<double> temperature;
      for (const Sample& sample : samples) {
        d.push_back(opening(sample.uvw, sample.side, s.times[j]));
        temperature.push_back(300 + sample.uvw.x * s.times[j] + (sample.uvw.y == 1.25 ? 4 : 0));
      }
      writer.write_frames(j, d);
      writer.write_array(array, j, temperature);
    }
    writer.finish(s);
    reader_.emplace(folder_ / "case.h5");
  }
  const SnapshotReader& reader() const { return *reader_; }
  std::string file() const { return folder_ / "case.h5"; }

 private:
  TemporaryFolder folder_;
  std::optional<SnapshotReader> reader_;
};

}  // namespace cleft
