// A snapshot without a solver: a row of wedges under a row of triangles, with random displacements.
#pragma once

#include <random>
#include <string>

#include "solver/snapshot/snapshot.h"

namespace cleft {

inline std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> numbers(count);
  for (double& number : numbers) number = normal(random);
  return numbers;
}

/// 6 points, a triangle and a wedge for each of `wedges`.
inline Snapshot wedge_row(int wedges, const std::vector<double>& times) {
  Snapshot s;
  s.cell_offsets = {0};
  for (int i = 0; i < wedges; ++i) {
    for (const double w : {0.0, -1.0})
      for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.7, 0.0}, {0.0, 0.1}})
        s.points.push_back({i + u, v, w});
    for (const int corners : {3, 6}) {
      s.cell_types.push_back(corners == 3 ? Snapshot::triangle : Snapshot::wedge);
      for (int c = 0; c < corners; ++c) s.connectivity.push_back(6 * i + c);
      s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
    }
  }
  s.times = times;
  s.released.assign(times.size(), 0);
  s.position = s.smallest_gap = s.residual_equilibrium = s.residual_closure =
      std::vector<double>(times.size());
  s.cut_length = s.cut_depth = 1;
  return s;
}

/// What the snapshot says of a frame, to be compared with.
inline std::vector<double> displacements(const Snapshot& s, std::size_t frame) {
  return random_numbers(3 * s.points.size(), static_cast<unsigned>(frame));
}

inline void write_snapshot(const std::string& path, const Snapshot& s) {
  SnapshotWriter writer(path, s);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    std::vector<Vec3> frame;
    const std::vector<double> numbers = displacements(s, j);
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      frame.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    writer.write_frames(j, frame);
  }
  writer.finish(s);
}

}  // namespace cleft
