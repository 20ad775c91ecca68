// The handling of signals while a study runs.
#pragma once

#include <csignal>
#include <initializer_list>
#include <map>

namespace cleft {

/// During its lifetime the signals call `handler`; destruction restores the former handlers.
class SignalHandler {
 public:
  SignalHandler(std::initializer_list<int> signals, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    for (const int signal : signals) sigaction(signal, &action, &before_[signal]);
  }
  ~SignalHandler() {
    for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
  }
  SignalHandler(const SignalHandler&) = delete;
  SignalHandler& operator=(const SignalHandler&) = delete;

 private:
  std::map<int, struct sigaction> before_;
};

}  // namespace cleft
