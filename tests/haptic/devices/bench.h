// A device on the bench: the test moves, feels, unplugs and plugs what the program takes for hardware.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "haptic/device.h"

namespace cleft::testing {

class Bench {
 public:
  virtual ~Bench() = default;
  virtual std::unique_ptr<Device> open(const ScalpelPose& start) = 0;
  virtual void push(double part) = 0;  ///< along the mesh's x: a deflection, or so many times 10 mm
  virtual void press(bool down) = 0;   ///< the cutting button
  virtual void unplug() = 0;
  virtual void plug() = 0;
  /// What the hand feels, N, or a part of the largest rumble; negative: this device has no motors.
  virtual double felt() { return -1; }
  virtual std::string remedy() const = 0;  ///< a word of the error where the driver or device is missing
};

std::unique_ptr<Bench> spacemouse_bench();
std::unique_ptr<Bench> gamepad_bench();
std::unique_ptr<Bench> phantom_bench();
std::unique_ptr<Bench> plugin_bench();

/// Asks until it is true, for two seconds at most.
template <class Condition>
bool soon(const Condition& condition) {
  for (int n = 0; n < 2000; ++n) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return condition();
}

}  // namespace cleft::testing
