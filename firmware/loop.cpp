#include "firmware/loop.hpp"

#include <chrono>

namespace cartwright::firmware {

Loop::Loop(Controller& controller, Pacer& pacer, std::int64_t period_ns, Telemetry& telemetry)
    : controller_(controller), pacer_(pacer), telemetry_(telemetry), period_ns_(period_ns) {
  deadline_ns_ = pacer.now_ns();
  last_ns_ = deadline_ns_;
}

void Loop::tick() noexcept {
  deadline_ns_ += period_ns_;
  pacer_.wait_until(deadline_ns_, controller_.state() != wire::State::running);
  const std::int64_t now_ns = pacer_.now_ns();
  const std::int64_t lateness_ns = now_ns - deadline_ns_;
  const std::int64_t missed = lateness_ns / period_ns_;
  const auto started = std::chrono::steady_clock::now();
  controller_.tick({now_ns, now_ns - last_ns_}, static_cast<double>(lateness_ns) * 1e-9,
                   static_cast<std::uint32_t>(missed));
  const auto took = std::chrono::steady_clock::now() - started;
  telemetry_.lateness.add(lateness_ns);
  telemetry_.step_time.add(std::chrono::nanoseconds(took).count());
  deadline_ns_ += missed * period_ns_;
  last_ns_ = now_ns;
}

}  // namespace cartwright::firmware
