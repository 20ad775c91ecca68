// A simulation of a body on another thread, so that its owner can go on.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "explorer/body/simulate.h"

namespace cleft {

class BodyRun {
 public:
  /// Begins at once.
  explicit BodyRun(BodyRequest request);
  /// Stops the simulation and waits for its end.
  ~BodyRun();
  BodyRun(const BodyRun&) = delete;
  BodyRun& operator=(const BodyRun&) = delete;

  /// What it is doing: "solving 9000 nodes".
  std::string step() const;
  bool ready() const;
  /// Waits for the end and calls `look` every tenth of a second; what that throws ends the waiting.
  void wait(const std::function<void()>& look) const;
  /// Once it is ready. Throws as simulate() did.
  const BodySimulation& result();

 private:
  mutable std::mutex mutex_;
  std::string step_;
  StopCount stop_ = 0;
  std::shared_future<BodySimulation> future_;
};

}  // namespace cleft
