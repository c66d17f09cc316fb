#pragma once

#include <algorithm>
#include <atomic>
#include <future>
#include <vector>

namespace navvi_floor {

/// Calls `work(i)` once for each i in [0, count), on up to `threads` threads in any order. What one
/// call throws is thrown here after all have ended.
template <typename Work>
void in_parallel(int count, int threads, const Work& work) {
  if (threads <= 1 || count <= 1) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<int> next{0};
  const auto run = [&] {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      throw;
    }
  };
  std::vector<std::future<void>> others;
  for (int k = 1; k < std::min(threads, count); ++k)
    others.push_back(std::async(std::launch::async, run));
  run();
  for (std::future<void>& other : others) other.get();
}

}  // namespace navvi_floor
