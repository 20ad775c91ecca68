// A libHD.so for tests: the functions of OpenHaptics' HD interface that Cleft calls, over a simulated arm of
// 0.1 kg whose hand follows a target, moved by a servo thread of 1 kHz.
#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

namespace {

std::mutex mutex;
double target[3], position[3], velocity[3], force[3], told[3];
int buttons = 0;
bool plugged = true, calibrated = true, error = false;
unsigned (*callback)(void*) = nullptr;
void* user = nullptr;
std::atomic<bool> running{false};
std::thread servo;

void move_arm() {
  const std::lock_guard lock(mutex);
  for (int k = 0; k < 3; ++k) {  // kg, N/mm, N s/mm; ms
    const double a = 1e3 / 0.1 * (0.5 * (target[k] - position[k]) - 0.014 * velocity[k] + force[k]);
    velocity[k] += 1e-3 * a;
    position[k] += 1e-3 * velocity[k];
  }
}

}  // namespace

extern "C" {

struct StubError {
  unsigned code;
  int internal;
  unsigned device;
};

// What the test does.
void stub_target(double x, double y, double z) {
  const std::lock_guard lock(mutex);
  target[0] = x, target[1] = y, target[2] = z;
}
void stub_buttons(int pressed) {
  const std::lock_guard lock(mutex);
  buttons = pressed;
}
void stub_plug(int in) {
  const std::lock_guard lock(mutex);
  plugged = in != 0;
}
void stub_calibrated(int is) {
  const std::lock_guard lock(mutex);
  calibrated = is != 0;
}
void stub_force(double* out) {
  const std::lock_guard lock(mutex);
  std::memcpy(out, told, sizeof told);
}

// What the program calls.
unsigned hdInitDevice(const char*) {
  const std::lock_guard lock(mutex);
  error = !plugged;
  std::memcpy(position, target, sizeof position);
  std::memset(velocity, 0, sizeof velocity);
  return plugged ? 1 : 0xFFFFFFFF;
}
void hdDisableDevice(unsigned) {
  const std::lock_guard lock(mutex);
  std::memset(force, 0, sizeof force);
}
void hdMakeCurrentDevice(unsigned) {}
void hdBeginFrame(unsigned) {}
void hdEndFrame(unsigned) {
  const std::lock_guard lock(mutex);
  error = error || !plugged;
}
void hdEnable(unsigned) {}
StubError hdGetError() {
  const std::lock_guard lock(mutex);
  const StubError last{error ? 0x0201u : 0u, 0, 1};
  error = false;
  return last;
}
const char* hdGetErrorString(unsigned) { return "communication error"; }
void hdGetDoublev(unsigned name, double* out) {
  const std::lock_guard lock(mutex);
  static const double box[6] = {-100, -50, -40, 100, 150, 60};
  switch (name) {
    case 0x2050:
      std::memcpy(out, position, sizeof position);
      break;
    case 0x2052:
      for (int k = 0; k < 16; ++k) out[k] = k % 5 == 0;
      std::memcpy(out + 12, position, sizeof position);
      break;
    case 0x2551:
      std::memcpy(out, box, sizeof box);
      break;
    case 0x2602:
      *out = 0.7;
      break;
    case 0x2603:
      *out = 3.3;
      break;
    case 0x2609:
      *out = 0.005;
      break;
    default:
      error = true;
  }
}
void hdGetIntegerv(unsigned name, int* out) {
  const std::lock_guard lock(mutex);
  *out = name == 0x2000 ? buttons : 4;
}
void hdSetDoublev(unsigned name, const double* in) {
  const std::lock_guard lock(mutex);
  if (name != 0x2700) error = true;
  std::memcpy(force, in, sizeof force);
  std::memcpy(told, in, sizeof told);
}
unsigned hdCheckCalibration() {
  const std::lock_guard lock(mutex);
  return calibrated ? 0x5000 : 0x5002;
}
void hdUpdateCalibration(unsigned) {}
void hdStartScheduler() {
  running = true;
  servo = std::thread([] {
    while (running) {
      move_arm();
      if (callback) callback(user);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}
void hdStopScheduler() {
  running = false;
  if (servo.joinable()) servo.join();
}
unsigned long hdScheduleAsynchronous(unsigned (*function)(void*), void* data, unsigned short) {
  user = data;
  callback = function;
  return 7;
}
void hdUnschedule(unsigned long) {}

}  // extern "C"
