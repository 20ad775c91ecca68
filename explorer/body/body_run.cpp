#include "explorer/body/body_run.h"

#include <chrono>
#include <utility>

namespace cleft {

BodyRun::BodyRun(BodyRequest request) {
  future_ = std::async(std::launch::async, [this, request = std::move(request)] {
              return simulate(
                  request,
                  [this](const std::string& step) {
                    const std::scoped_lock lock(mutex_);
                    step_ = step;
                  },
                  &stop_);
            }).share();
}

BodyRun::~BodyRun() {
  stop_ = 2;
  future_.wait();
}

std::string BodyRun::step() const {
  const std::scoped_lock lock(mutex_);
  return step_;
}

bool BodyRun::ready() const { return future_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

void BodyRun::wait(const std::function<void()>& look) const {
  while (future_.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) look();
}

const BodySimulation& BodyRun::result() { return future_.get(); }

}  // namespace cleft
