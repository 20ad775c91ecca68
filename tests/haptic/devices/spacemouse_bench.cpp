// spacenavd's side of the socket: the hello of its protocol, then 32-byte packets.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>

#include "haptic/devices/spacemouse.h"
#include "tests/haptic/devices/bench.h"
#include "tests/support/temporary_folder.h"

namespace cleft::testing {

namespace {

class Daemon : public Bench {
 public:
  Daemon() : place_(folder_ / "spnav.sock") {
    setenv("SPNAV_SOCKET", place_.c_str(), 1);
    plug();
  }
  ~Daemon() override {
    if (running_) unplug();
  }
  std::unique_ptr<Device> open(const ScalpelPose& start) override {
    return std::make_unique<SpaceMouse>(start);
  }
  void push(double part) override { send({0, static_cast<std::int32_t>(350 * part), 0, 0, 0, 0, 0, 16}); }
  void press(bool down) override { send({down ? 1 : 2, 0, 0, 0, 0, 0, 0, 0}); }
  void plug() override {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    place_.copy(address.sun_path, sizeof address.sun_path - 1);
    listening_ = socket(AF_UNIX, SOCK_STREAM, 0);
    unlink(place_.c_str());
    ASSERT_EQ(bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(listen(listening_, 4), 0);
    running_ = true;
    thread_ = std::thread([this] { serve(); });
  }
  void unplug() override {
    running_ = false;
    thread_.join();
    close(listening_);
    if (client_ >= 0) close(client_);
    client_ = -1;
    unlink(place_.c_str());
  }
  std::string remedy() const override { return "install the package spacenavd"; }

 private:
  void serve() {
    while (running_) {
      pollfd waiting{listening_, POLLIN, 0};
      if (poll(&waiting, 1, 10) <= 0) continue;
      const int client = accept(listening_, nullptr, nullptr);
      std::int32_t hello = 0;
      if (read(client, &hello, sizeof hello) != sizeof hello) continue;
      if (write(client, &hello, sizeof hello) != sizeof hello)
        continue;  // the requested version is the one used
      const std::lock_guard lock(mutex_);
      client_ = client;
    }
  }
  void send(const std::array<std::int32_t, 8>& packet) {
    ASSERT_TRUE(soon([this] {
      const std::lock_guard lock(mutex_);
      return client_ >= 0;
    }));
    const std::lock_guard lock(mutex_);
    ASSERT_EQ(write(client_, packet.data(), sizeof packet), static_cast<ssize_t>(sizeof packet));
  }

  TemporaryFolder folder_;
  std::string place_;
  int listening_ = -1, client_ = -1;
  std::mutex mutex_;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Bench> spacemouse_bench() { return std::make_unique<Daemon>(); }

}  // namespace cleft::testing
