#include "tradeoff/frame_time.h"

#include <random>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "explorer/scene/replay_pieces.h"

namespace cleft {

double frame_seconds(const Field& field) {
  constexpr int count = 10000, frames = 101;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(field.domain(0).front, field.domain(0).back),
      across(field.domain(1).front, field.domain(1).back);
  const double tolerance = field.contraction_tolerance();
  const Field* const fields[] = {&field};
  const std::vector<double> times = replay_times(fields, tolerance);
  std::vector<Vec3> rest, out(count);
  std::vector<int> vertices;
  for (int i = 0; i < count; ++i) rest.push_back({along(random), across(random), 0}), vertices.push_back(i);
  ReplayPieces pieces(times, std::vector<double>(count), vertices);
  History history;
  for (const Vec3& at : rest) {
    field.contract(at, at.y < 0 ? Side::left : Side::right, tolerance, times, history);
    pieces.append(history);
  }
  std::vector<double> seconds;
  for (int frame = 0; frame < frames; ++frame) {
    Stopwatch watch;
    pieces.positions(field.duration() * frame / (frames - 1), rest.data(), out.data());
    seconds.push_back(watch.lap());
  }
  return median(seconds);
}

}  // namespace cleft
