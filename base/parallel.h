// A loop over all cores.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cleft {

/// Calls work(i) for i = 0 .. count - 1, in any order, on all cores. The first exception is rethrown.
template <class Work>
void parallel_for(int count, const Work& work) {
  std::atomic<int> next = 0;
  std::exception_ptr failure;
  std::mutex guard;
  const auto run = [&] {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1;
       i < std::min<unsigned>(std::thread::hardware_concurrency(), static_cast<unsigned>(count)); ++i)
    others.emplace_back(run);
  run();
  others.clear();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace cleft
