#pragma once

#include <cstdint>

namespace cartwright::firmware {

/// How the loop waits for its next tick. The loop does not know whether time is real.
class Pacer {
 public:
  virtual ~Pacer() = default;
  virtual std::int64_t now_ns() noexcept = 0;
  /// Returns once the deadline has passed. `idle`: no experiment runs, no one minds a wait in real time.
  virtual void wait_until(std::int64_t deadline_ns, bool idle) noexcept = 0;
};

/// CLOCK_MONOTONIC and absolute deadlines: lateness does not add up.
class RealPacer final : public Pacer {
 public:
  std::int64_t now_ns() noexcept override;
  void wait_until(std::int64_t deadline_ns, bool idle) noexcept override;
};

/// Time that jumps to the deadline: an experiment runs as fast as the machine computes it. While idle each
/// tick takes some real time, so that a controller waiting for its host leaves the machine alone.
class VirtualPacer final : public Pacer {
 public:
  /// `rest_ns`: real time of an idle tick; 0 never rests.
  explicit VirtualPacer(std::int64_t rest_ns = 0) : rest_ns_(rest_ns) {}
  std::int64_t now_ns() noexcept override { return now_ns_; }
  void wait_until(std::int64_t deadline_ns, bool idle) noexcept override;

 private:
  std::int64_t now_ns_ = 0, rest_ns_;
};

}  // namespace cartwright::firmware
