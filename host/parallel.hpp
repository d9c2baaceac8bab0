#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace cartwright {

/// Calls `task(i)` for i in [0, count), spread over `threads` threads; returns when all are done.
template <typename Task>
void parallel_for(std::size_t count, unsigned threads, Task task) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < count;) task(i);
  };
  std::vector<std::jthread> pool;
  for (unsigned i = 1; i < std::min<std::size_t>(threads, count); ++i) pool.emplace_back(work);
  work();
}

}  // namespace cartwright
