// Finds the guard of wounds on a thread of its own, so that the step that ends a cut does not wait for it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "explorer/wound/live_wounds.h"

namespace cleft {

class GuardFinder {
 public:
  GuardFinder() = default;
  ~GuardFinder();
  GuardFinder(const GuardFinder&) = delete;
  GuardFinder& operator=(const GuardFinder&) = delete;

  /// Starts the thread, if it is not running, so that begin() need not.
  void start();
  /// Begins to find the guard. Until it is taken or given up, the wounds and their mesh must not change.
  void begin(const LiveWounds& wounds);
  /// Whether a guard has been begun, and neither taken nor given up.
  bool busy() const { return wounds_ != nullptr; }
  /// The guard, if it has been found; `wait`: once it has.
  std::optional<Guard> take(bool wait);
  /// Gives the guard up, and returns when nothing reads the wounds any more.
  void give_up();

 private:
  void follow();

  const LiveWounds* wounds_ = nullptr;  // of the thread that asks
  std::mutex mutex_;
  std::condition_variable changed_;
  const LiveWounds* wanted_ = nullptr;  // by the mutex, as what follows: being looked at
  std::optional<Guard> found_;
  bool end_ = false;
  std::atomic<bool> given_up_{false};
  std::thread thread_;
};

}  // namespace cleft
