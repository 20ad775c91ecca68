#include "explorer/scalpel/guard_finder.h"

#include <utility>

namespace cleft {

namespace {
struct GivenUp {};
}  // namespace

GuardFinder::~GuardFinder() {
  if (!thread_.joinable()) return;
  give_up();
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void GuardFinder::start() {
  if (!thread_.joinable()) thread_ = std::thread([this] { follow(); });
}

void GuardFinder::begin(const LiveWounds& wounds) {
  start();
  wounds_ = &wounds;
  {
    const std::lock_guard lock(mutex_);
    wanted_ = &wounds;
  }
  changed_.notify_all();
}

std::optional<Guard> GuardFinder::take(bool wait) {
  std::unique_lock lock(mutex_);
  if (wait) changed_.wait(lock, [this] { return wanted_ == nullptr; });
  if (wanted_) return std::nullopt;
  wounds_ = nullptr;
  return std::exchange(found_, std::nullopt);
}

void GuardFinder::give_up() {
  if (!busy()) return;
  given_up_ = true;
  take(true);
  given_up_ = false;
}

void GuardFinder::follow() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return end_ || wanted_; });
    if (end_) return;
    const LiveWounds& wounds = *wanted_;
    lock.unlock();
    std::optional<Guard> found;
    try {
      found = wounds.find_guard([this] {
        if (given_up_) throw GivenUp();
      });
    } catch (const GivenUp&) {
    }
    lock.lock();
    found_ = std::move(found);
    wanted_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace cleft
