// The haptic loop: pose, collision, force, at a fixed rate. Paper, section 3.6.
//
//   HapticLoop loop(device, surface, parameters, {});
//   loop.update(dt);                 a tick, for simulations and tests
//   loop.run(stop);                  ticks at absolute times, on a thread of its own
//
// A tick takes no lock, no memory and no system call; with options.measure two, to read the thread's CPU
// clock.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "haptic/device.h"
#include "haptic/force_model.h"
#include "haptic/loop_statistics.h"
#include "haptic/passivity.h"
#include "haptic/tick_queue.h"
#include "haptic/triple_buffer.h"

namespace cleft {

/// The state of a tick for the rest of the program.
struct HapticState {
  std::uint64_t tick = 0;
  double time = 0;  ///< s
  ScalpelPose pose;
  Vec3 force;  ///< N, as rendered
  Phase phase = Phase::free;
  double depth = 0;  ///< mm
  Vec3 proxy, normal;
  int punctures = 0;
};

/// A pose with its time, for recordings.
struct RecordedPose {
  double time;
  ScalpelPose pose;
};

struct LoopOptions {
  double rate = 1000;      ///< Hz
  bool measure = false;    ///< compute times
  bool real_time = false;  ///< request SCHED_FIFO and locked memory; refused(): what was not granted
  bool passive = true;     ///< false: the plain force model, to demonstrate the controller
  std::size_t record = 0;  ///< number of poses to record
};

class HapticLoop {
 public:
  HapticLoop(Device& device, const ContactSurface& surface, const ForceParameters& parameters,
             const LoopOptions& options = {});

  /// One tick, dt s after the one before.
  void update(double dt);

  /// Ticks at absolute times until `stop`, for `seconds` or, without them, as long as the device moves.
  /// Missed times are skipped.
  void run(const std::atomic<bool>& stop, std::optional<double> seconds = {});

  double rate() const { return options_.rate; }
  double period() const { return 1 / options_.rate; }

  /// All ticks, for the cutting thread, so that it cuts the complete path of the blade even if it is late;
  /// and the newest tick, for the drawing thread.
  TickQueue<HapticState>& for_cutting() { return for_cutting_; }
  TripleBuffer<HapticState>& for_view() { return for_view_; }

  // While the loop runs these belong to its thread.
  const HapticState& state() const { return state_; }
  const LoopStatistics& statistics() const { return statistics_; }
  const PassivityControl& passivity() const { return passivity_; }
  const ForceModel& model() const { return model_; }
  const std::vector<RecordedPose>& recorded() const { return recorded_; }
  const std::string& refused() const { return refused_; }  ///< "" if real time was granted or not requested

 private:
  void count(const Vec3& force);

  Device& device_;
  LoopOptions options_;
  ForceParameters parameters_;
  DeviceLimits limits_;
  ForceModel model_;
  PassivityControl passivity_;
  HapticState state_;
  LoopStatistics statistics_;
  TickQueue<HapticState> for_cutting_;
  TripleBuffer<HapticState> for_view_;
  std::vector<RecordedPose> recorded_;
  std::string refused_;
};

}  // namespace cleft
