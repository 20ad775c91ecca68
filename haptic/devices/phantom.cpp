#include "haptic/devices/phantom.h"

#include <chrono>

#include "haptic/devices/shared_library.h"

namespace cleft {

namespace {

constexpr const char* phantom_name = "phantom";

// OpenHaptics Toolkit, API Reference: types and names of the HD interface.
using HHD = unsigned int;
using HDenum = unsigned int;
using HDerror = unsigned int;
using HDSchedulerHandle = unsigned long;
using HDSchedulerCallback = unsigned int (*)(void*);
struct HDErrorInfo {
  HDerror errorCode;
  int internalErrorCode;
  HHD hHD;
};
constexpr HHD HD_INVALID_HANDLE = 0xFFFFFFFF;
constexpr HDerror HD_SUCCESS = 0;
constexpr HDenum HD_CURRENT_BUTTONS = 0x2000, HD_CURRENT_POSITION = 0x2050, HD_CURRENT_TRANSFORM = 0x2052,
                 HD_USABLE_WORKSPACE_DIMENSIONS = 0x2551, HD_CALIBRATION_STYLE = 0x2555,
                 HD_NOMINAL_MAX_STIFFNESS = 0x2602, HD_NOMINAL_MAX_FORCE = 0x2603,
                 HD_NOMINAL_MAX_DAMPING = 0x2609, HD_CURRENT_FORCE = 0x2700, HD_FORCE_OUTPUT = 0x4000,
                 HD_CALIBRATION_OK = 0x5000, HD_CALIBRATION_NEEDS_UPDATE = 0x5001;
constexpr unsigned HD_CALLBACK_CONTINUE = 1;
constexpr unsigned short HD_MAX_SCHEDULER_PRIORITY = 65535;

/// HD: x right, y up, z towards the user; a mesh's z is up.
Vec3 from_device(const double* v) { return {v[0], -v[2], v[1]}; }
void to_device(const Vec3& v, double* out) { out[0] = v.x, out[1] = v.z, out[2] = -v.y; }

}  // namespace

struct Phantom::Library {
  SharedLibrary library;
  HHD (*init)(const char*);
  void (*disable_device)(HHD);
  void (*make_current)(HHD);
  void (*begin_frame)(HHD);
  void (*end_frame)(HHD);
  void (*enable)(HDenum);
  HDErrorInfo (*error)();
  const char* (*error_text)(HDerror);
  void (*get_doubles)(HDenum, double*);
  void (*get_integers)(HDenum, int*);
  void (*set_doubles)(HDenum, const double*);
  HDenum (*check_calibration)();
  void (*update_calibration)(HDenum);
  void (*start)();
  void (*stop)();
  HDSchedulerHandle (*schedule)(HDSchedulerCallback, void*, unsigned short);
  void (*unschedule)(HDSchedulerHandle);
  HHD device = HD_INVALID_HANDLE;
  HDSchedulerHandle job = 0;

  explicit Library(const std::string& file)
      : library(phantom_name, file, "install OpenHaptics and the driver of your device, from its maker") {
    library.find(init, "hdInitDevice");
    library.find(disable_device, "hdDisableDevice");
    library.find(make_current, "hdMakeCurrentDevice");
    library.find(begin_frame, "hdBeginFrame");
    library.find(end_frame, "hdEndFrame");
    library.find(enable, "hdEnable");
    library.find(error, "hdGetError");
    library.find(error_text, "hdGetErrorString");
    library.find(get_doubles, "hdGetDoublev");
    library.find(get_integers, "hdGetIntegerv");
    library.find(set_doubles, "hdSetDoublev");
    library.find(check_calibration, "hdCheckCalibration");
    library.find(update_calibration, "hdUpdateCalibration");
    library.find(start, "hdStartScheduler");
    library.find(stop, "hdStopScheduler");
    library.find(schedule, "hdScheduleAsynchronous");
    library.find(unschedule, "hdUnschedule");
  }
};

Phantom::Phantom(const ScalpelPose& start, const std::string& library)
    : start_(start), hd_(std::make_unique<Library>(library)), pose_(absent()) {
  open();
  watcher_ = std::thread([this] { watch(); });
}

Phantom::~Phantom() {
  stop_ = true;
  watcher_.join();
  if (hd_->device != HD_INVALID_HANDLE) close();
}

void Phantom::open() {
  const HHD device = hd_->init(nullptr);
  if (const HDErrorInfo e = hd_->error(); e.errorCode != HD_SUCCESS || device == HD_INVALID_HANDLE)
    throw InputError(std::string("phantom: the device does not answer (") + hd_->error_text(e.errorCode) +
                     "): plug it in, switch it on, and set it up with its maker's tools");
  hd_->make_current(device);
  if (hd_->check_calibration() == HD_CALIBRATION_NEEDS_UPDATE) {
    int style = 0;
    hd_->get_integers(HD_CALIBRATION_STYLE, &style);
    hd_->update_calibration(static_cast<HDenum>(style));
  }
  if (hd_->check_calibration() != HD_CALIBRATION_OK) {
    hd_->disable_device(device);
    throw InputError("phantom: the device is not calibrated: put its pen into the inkwell and start again");
  }
  double force = 0, stiffness = 0, damping = 0, box[6]{};
  hd_->get_doubles(HD_NOMINAL_MAX_FORCE, &force);
  hd_->get_doubles(HD_NOMINAL_MAX_STIFFNESS, &stiffness);
  hd_->get_doubles(HD_NOMINAL_MAX_DAMPING, &damping);
  hd_->get_doubles(HD_USABLE_WORKSPACE_DIMENSIONS, box);
  const Vec3 low = from_device(box), high = from_device(box + 3);
  middle_ = 0.5 * (low + high);
  if (hd_->job == 0)
    limits_ = {force, stiffness, damping, 1e-3};  // of the first time: the loop was made for them
  hd_->device = device;
  hd_->enable(HD_FORCE_OUTPUT);
  hd_->job = hd_->schedule(&Phantom::servo, this, HD_MAX_SCHEDULER_PRIORITY);
  hd_->start();
}

void Phantom::close() {
  hd_->unschedule(hd_->job);
  hd_->stop();
  hd_->disable_device(hd_->device);
  hd_->device = HD_INVALID_HANDLE;
}

unsigned Phantom::servo(void* self) {
  static_cast<Phantom*>(self)->tick();
  return HD_CALLBACK_CONTINUE;
}

void Phantom::tick() {
  ScalpelPose pose = start_;
  double position[3]{}, transform[16]{}, force[3];
  int buttons = 0;
  hd_->make_current(hd_->device);
  hd_->begin_frame(hd_->device);
  hd_->get_doubles(HD_CURRENT_POSITION, position);
  hd_->get_doubles(HD_CURRENT_TRANSFORM, transform);
  hd_->get_integers(HD_CURRENT_BUTTONS, &buttons);
  to_device(force_.read(), force);
  hd_->set_doubles(HD_CURRENT_FORCE, force);
  hd_->end_frame(hd_->device);
  if (hd_->error().errorCode != HD_SUCCESS) {
    lost_ = true;
    pose = absent(pose);
  } else {
    // Columns of the transform: the pen's own axes; its z points from the tip to the handle, its buttons are
    // on top.
    pose.tip = start_.tip + from_device(position) - middle_;
    pose.axis = from_device(transform + 8);
    pose.edge = -from_device(transform + 4);
    pose.cutting = (buttons & 1) != 0;
  }
  pose_.write(pose);
}

ScalpelPose Phantom::read(double) {
  const ScalpelPose& pose = pose_.read();
  return lost_.load(std::memory_order_relaxed) ? absent(pose) : pose;
}

/// A device that is lost is let go, and asked for again until it is back.
void Phantom::watch() {
  using namespace std::chrono_literals;
  for (int n = 0; !stop_; ++n, std::this_thread::sleep_for(20ms)) {
    if (!lost_ || n % 10) continue;
    if (hd_->device != HD_INVALID_HANDLE) {
      close();
      pose_.write(absent(start_));
    }
    try {
      open();
      lost_ = false;
    } catch (const InputError&) {  // not yet
    }
  }
}

DeviceKind phantom_device() {
  return {.name = phantom_name,
          .title = "&PHANToM or Touch",
          .help = "a force feedback arm; needs its maker's OpenHaptics",
          .make = [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            return std::make_unique<Phantom>(request.start);
          }};
}

}  // namespace cleft
