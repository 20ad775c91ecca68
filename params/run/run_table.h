// The output during a run: lines, and on a terminal a table below them that is updated.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cleft {

class RunTable {
 public:
  /// `rows` returns the lines of the table; it is called twice a second from a thread of its own.
  explicit RunTable(std::function<std::vector<std::string>()> rows);
  ~RunTable();
  RunTable(const RunTable&) = delete;
  RunTable& operator=(const RunTable&) = delete;

  /// Prints a permanent line.
  void say(const std::string& line);

 private:
  void keep_up();
  void erase();  // the table, from the terminal

  std::function<std::vector<std::string>()> rows_;
  const bool terminal_;
  std::size_t drawn_ = 0;  // lines
  bool ended_ = false;
  std::mutex mutex_;
  std::condition_variable end_;
  std::thread thread_;
};

/// Seconds as "1:02:03" or "2:03".
std::string as_clock(double seconds);

}  // namespace cleft
