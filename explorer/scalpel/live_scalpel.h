// A haptic scalpel on threads of its own: the loop at 1 kHz on one, the mesh that it cuts on another; a third
// thread may draw their state.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "explorer/scalpel/cutting_moment.h"

namespace cleft {

class LiveScalpel {
 public:
  using Places = std::vector<ScalpelPath::Point>;

  /// Starts at once. The device must outlive it. Throws InputError if a cut of the setup cannot be made.
  LiveScalpel(const SurfaceMesh& mesh, ScalpelCutting::Setup setup, Device& device,
              const ForceParameters& force);
  ~LiveScalpel();

  // For the drawing thread only.
  const HapticState& state() { return loop_.for_view().read(); }
  /// The state as of the last call or later; requests the next one.
  std::shared_ptr<const CuttingMoment> moment();
  /// The cuts that ended since the last call, mesh units.
  std::vector<Places> ended_cuts();
  /// Ends both threads and the current cut, and returns ended_cuts().
  std::vector<Places> stop();
  /// Why the cut could not continue; reported once.
  std::string stopped();
  const ContactSurface& surface() const { return cutting_.surface(); }

 private:
  void follow();
  void tell();

  ScalpelCutting cutting_;
  HapticLoop loop_;
  std::atomic<bool> stop_{false}, wanted_{true};
  std::mutex mutex_;  // between the thread that cuts and the one that draws
  std::shared_ptr<const CuttingMoment> moment_;
  std::vector<Places> ended_;
  std::string stopped_, stopped_before_;
  std::size_t ended_count_ = 0;
  std::thread ticks_, cuts_;
};

}  // namespace cleft
