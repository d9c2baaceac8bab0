#include "firmware/pacer.hpp"

#include <cerrno>
#include <ctime>

namespace cartwright::firmware {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

timespec to_timespec(std::int64_t ns) {
  return {ns / kSecond_ns, ns % kSecond_ns};
}

}  // namespace

std::int64_t RealPacer::now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

void RealPacer::wait_until(std::int64_t deadline_ns, bool /*idle*/) noexcept {
  const timespec deadline = to_timespec(deadline_ns);
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

void VirtualPacer::wait_until(std::int64_t deadline_ns, bool idle) noexcept {
  if (idle && rest_ns_ > 0) {
    const timespec rest = to_timespec(rest_ns_);
    ::clock_nanosleep(CLOCK_MONOTONIC, 0, &rest, nullptr);
  }
  if (deadline_ns > now_ns_) now_ns_ = deadline_ns;
}

}  // namespace cartwright::firmware
