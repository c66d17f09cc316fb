#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace navvi_nav::map {

/// Calls `work(i)` once for each i in [0, count), on up to `threads` threads in any order. What one
/// call throws is thrown here after all have ended.
template <typename Work>
void in_parallel(int count, int threads, const Work& work) {
  if (threads <= 1 || count <= 1) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<int> next{0};
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::min(threads, count)));
  const auto run = [&](std::exception_ptr& failure) {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  others.reserve(failures.size() - 1);
  for (std::size_t k = 1; k < failures.size(); ++k)
    others.emplace_back([&run, &failure = failures[k]] { run(failure); });
  run(failures[0]);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace navvi_nav::map
