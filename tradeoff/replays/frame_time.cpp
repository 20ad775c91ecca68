#include "tradeoff/replays/frame_time.h"

#include <random>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "explorer/wound/replay_pieces.h"

namespace cleft {

double frame_seconds(const Field& field, double detail) {
  constexpr int count = 10000, frames = 101;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(field.domain(0).front, field.domain(0).back),
      across(field.domain(1).front, field.domain(1).back);
  const double tolerance = field.contraction_tolerance();
  const Field* const fields[] = {&field};
  const std::vector<double> times = replay_times(fields, tolerance);
  const auto rests = [&](const History& history) {
    for (const auto& piece : history.controls)
      for (const Vec3& d : piece)
        if (norm(d) > detail) return false;
    return detail > 0;
  };
  std::vector<Vec3> rest, out(count);
  std::vector<int> vertices;
  std::vector<History> histories;
  for (int i = 0; i < count; ++i) {
    rest.push_back({along(random), across(random), 0});
    History history;
    field.contract(rest.back(), rest.back().y < 0 ? Side::left : Side::right, tolerance, times, history);
    if (rests(history)) continue;
    vertices.push_back(i), histories.push_back(std::move(history));
  }
  ReplayPieces pieces(times, std::vector<double>(vertices.size()), vertices);
  for (const History& history : histories) pieces.append(history);
  std::vector<double> seconds;
  for (int frame = 0; frame < frames; ++frame) {
    Stopwatch watch;
    pieces.positions(field.duration() * frame / (frames - 1), rest.data(), out.data());
    seconds.push_back(watch.lap());
  }
  return median(seconds);
}

}  // namespace cleft
