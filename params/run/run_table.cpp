#include "params/run/run_table.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace cleft {

namespace {

winsize terminal_size() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0) size.ws_row = 24, size.ws_col = 80;
  return size;
}

}  // namespace

RunTable::RunTable(std::function<std::vector<std::string>()> rows)
    : rows_(std::move(rows)), terminal_(isatty(STDERR_FILENO) == 1) {
  if (terminal_) thread_ = std::thread([this] { keep_up(); });
}

RunTable::~RunTable() {
  if (!terminal_) return;
  {
    const std::lock_guard guard(mutex_);
    ended_ = true;
  }
  end_.notify_all();
  thread_.join();
  erase();
}

void RunTable::say(const std::string& line) {
  const std::lock_guard guard(mutex_);
  erase();
  std::cerr << line << "\n";
}

void RunTable::keep_up() {
  std::unique_lock guard(mutex_);
  while (!end_.wait_for(guard, std::chrono::milliseconds(500), [this] { return ended_; })) {
    guard.unlock();
    const std::vector<std::string> rows = rows_();  // takes locks of its own
    guard.lock();
    erase();
    const winsize size = terminal_size();
    drawn_ = std::min<std::size_t>(rows.size(), size.ws_row > 2 ? size.ws_row - 2u : 1u);
    for (std::size_t i = 0; i < drawn_; ++i) std::cerr << rows[i].substr(0, size.ws_col - 1u) << "\n";
    std::cerr << std::flush;
  }
}

void RunTable::erase() {
  if (drawn_ > 0) std::cerr << "\033[" << drawn_ << "A\033[J" << std::flush;
  drawn_ = 0;
}

std::string as_clock(double seconds) {
  const long all = std::lround(std::max(0., seconds));
  char text[40];
  if (all >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", all / 3600, all / 60 % 60, all % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", all / 60, all % 60);
  return text;
}

}  // namespace cleft
