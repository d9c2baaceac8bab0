#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace cartwright::firmware {

/// One writer shows a value to any number of readers without a lock: a sequence lock over atomic words. The
/// writer never waits; a reader that meets a write half way reads again. (Boehm, "Can seqlocks get along with
/// programming language memory models?", 2012: release stores and acquire loads of the data make it free of
/// races.)
template <typename Value>
class Published {
  static_assert(std::is_trivially_copyable_v<Value>);

 public:
  Published() { write(Value{}); }

  void write(const Value& value) noexcept {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(Value));
    const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed);
    sequence_.store(sequence + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    sequence_.store(sequence + 2, std::memory_order_release);
  }

  Value read() const noexcept {
    std::array<std::uint64_t, kWords> words;
    while (true) {
      const std::uint64_t before = sequence_.load(std::memory_order_acquire);
      for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      const std::uint64_t after = sequence_.load(std::memory_order_relaxed);
      if (before == after && (before & 1U) == 0) break;
    }
    Value value;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(Value));
    return value;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(Value) + 7) / 8;
  std::atomic<std::uint64_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace cartwright::firmware
