// A scalpel that is felt, beside whatever draws: the loop of 1 kHz on one thread, the mesh that it cuts on
// another, and what both are at for a third.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "explorer/scalpel/cutting_moment.h"

namespace cleft {

class LiveScalpel {
 public:
  using Places = std::vector<ScalpelPath::Point>;

  /// Begins at once. The device must outlive it. Throws InputError where a cut of the setup cannot be made.
  LiveScalpel(const SurfaceMesh& mesh, ScalpelCutting::Setup setup, Device& device,
              const ForceParameters& force);
  ~LiveScalpel();

  // For the one thread that draws.
  const HapticState& state() { return loop_.for_view().read(); }
  /// As of the last call or later; asks for the next.
  std::shared_ptr<const CuttingMoment> moment();
  /// The cuts that were ended since the last call, mesh units.
  std::vector<Places> ended_cuts();
  /// Ends both threads, and the cut that goes on: returns what ended_cuts() would.
  std::vector<Places> stop();
  /// Why the cut could not go on, once.
  std::string stopped();
  const ContactSurface& surface() const { return cutting_.surface(); }

 private:
  void follow();
  void tell();

  ScalpelCutting cutting_;
  HapticLoop loop_;
  std::atomic<bool> stop_{false}, wanted_{true};
  std::mutex told_;  // between the thread that cuts and the one that draws
  std::shared_ptr<const CuttingMoment> moment_;
  std::vector<Places> ended_;
  std::string stopped_, stopped_before_;
  std::size_t ended_count_ = 0;
  std::thread ticks_, cuts_;
};

}  // namespace cleft
