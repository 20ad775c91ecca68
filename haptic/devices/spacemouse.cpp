#include "haptic/devices/spacemouse.h"

#include <poll.h>
#include <spnav.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdlib>

#include "haptic/devices/shared_library.h"

namespace cleft {

namespace {

constexpr const char* spacemouse_name = "spacemouse";
constexpr double full = 350;  // counts of a 3Dconnexion device pushed all the way
constexpr int patience = 20;  // ms between looks at whether to stop
constexpr auto reconnect_every = std::chrono::milliseconds(200);

Vec3 part(int x, int y, int z) {
  const auto of = [](int counts) { return std::clamp(counts / full, -1., 1.); };
  // spacenavd: x right, y up, z towards the user; a mesh's z is up.
  return {of(x), -of(z), of(y)};
}

}  // namespace

struct SpaceMouse::Library {
  SharedLibrary library{spacemouse_name, "libspnav.so.0", "install the package libspnav0"};
  decltype(spnav_open)* open;
  decltype(spnav_close)* close;
  decltype(spnav_fd)* fd;
  decltype(spnav_poll_event)* poll_event;

  Library() {
    library.find(open, "spnav_open");
    library.find(close, "spnav_close");
    library.find(fd, "spnav_fd");
    library.find(poll_event, "spnav_poll_event");
  }
};

SpaceMouse::SpaceMouse(const ScalpelPose& start) : spnav_(std::make_unique<Library>()), pose_(start) {
  if (spnav_->open() < 0) {
    const char* place = std::getenv("SPNAV_SOCKET");
    throw InputError("spacemouse: no spacenavd answers at " +
                     std::string(place ? place : "its usual socket") +
                     ": install the package spacenavd, start its service and plug the SpaceMouse in");
  }
  watcher_ = std::thread([this] { watch(); });
}

SpaceMouse::~SpaceMouse() {
  stop_ = true;
  watcher_.join();
}

void SpaceMouse::watch() {
  bool connected = true;
  Deflection d;
  d.present = true;
  deflection_.write(d);
  auto tried = std::chrono::steady_clock::now();
  while (!stop_) {
    if (!connected) {
      std::this_thread::sleep_for(std::chrono::milliseconds(patience));
      if (std::chrono::steady_clock::now() - tried < reconnect_every) continue;
      tried = std::chrono::steady_clock::now();
      connected = spnav_->open() >= 0;
      d = {};
      d.present = connected;
      deflection_.write(d);
      continue;
    }
    pollfd socket{spnav_->fd(), POLLIN, 0};
    if (poll(&socket, 1, patience) <= 0) continue;
    if (!handle_events(d)) {
      spnav_->close();
      connected = false;
      d = {};
    }
    deflection_.write(d);
  }
  if (connected) spnav_->close();
}

/// False where the daemon is gone.
bool SpaceMouse::handle_events(Deflection& d) {
  char byte;
  if (recv(spnav_->fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0) return false;
  spnav_event event;
  while (spnav_->poll_event(&event)) {
    if (event.type == SPNAV_EVENT_MOTION) {
      const spnav_event_motion& m = event.motion;
      d.move = part(m.x, m.y, m.z), d.turn = part(m.rx, m.ry, m.rz);
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum == 0) {
      d.cutting = event.button.press != 0;
    } else if (event.type == SPNAV_EVENT_DEV) {
      const bool present = event.dev.op == SPNAV_DEV_ADD;
      d = {};
      d.present = present;
    }
  }
  return true;
}

DeviceKind spacemouse_device() {
  return {
      .name = spacemouse_name,
      .title = "&SpaceMouse",
      .help = "pushing moves the blade, twisting turns it, button 1 cuts; through spacenavd, without forces",
      .make = [](const DeviceRequest& request) -> std::unique_ptr<Device> {
        return std::make_unique<SpaceMouse>(request.start);
      }};
}

}  // namespace cleft
