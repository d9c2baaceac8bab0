#pragma once

#include <atomic>

namespace cartwright::firmware {

/// One letter from one sender to one receiver, without a lock: the sender may write while it is empty, the
/// receiver reads while it is full. Neither waits.
template <typename Letter>
class Mailbox {
 public:
  bool empty() const noexcept { return !full_.load(std::memory_order_acquire); }

  /// Sender. False, and nothing posted, while the last letter has not been taken.
  bool post(const Letter& letter) noexcept {
    if (!empty()) return false;
    letter_ = letter;
    full_.store(true, std::memory_order_release);
    return true;
  }

  /// Receiver. Null while there is none; `taken` gives the box back.
  const Letter* peek() const noexcept { return full_.load(std::memory_order_acquire) ? &letter_ : nullptr; }
  void taken() noexcept { full_.store(false, std::memory_order_release); }

 private:
  std::atomic<bool> full_{false};
  Letter letter_{};
};

}  // namespace cartwright::firmware
