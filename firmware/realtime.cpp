#include "firmware/realtime.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace cartwright::firmware {
namespace {

/// Above the kernel's threaded interrupt handlers (50), so that a network burst does not delay a tick.
constexpr int kPriority = 80;

void touch_stack() {
  std::array<volatile char, 256 * 1024> stack;
  for (std::size_t i = 0; i < stack.size(); i += 4096) stack[i] = 1;
}

}  // namespace

Realtime prepare_process() {
  Realtime out;
  out.memory = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (!out.memory) {
    out.missing.push_back(
        fmt::format("memory is not locked ({}): a page fault may delay a tick by milliseconds; allow it with "
                    "ulimit -l unlimited",
                    std::strerror(errno)));
  }
  touch_stack();
  // The kernel keeps the request for as long as the file is open; it is meant to stay open.
  const int latency = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t none = 0;
  out.latency = latency >= 0 && ::write(latency, &none, sizeof none) == static_cast<ssize_t>(sizeof none);
  if (!out.latency) {
    out.missing.push_back(
        fmt::format("/dev/cpu_dma_latency is not held ({}): waking from deep sleep may cost some 100 us; "
                    "run as root or give the device to a group",
                    std::strerror(errno)));
  }
  return out;
}

void prepare_thread(Realtime& realtime) {
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  // Reset on fork: the server's thread, started from this one, is an ordinary one again.
  realtime.scheduler = ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
  if (!realtime.scheduler) {
    realtime.missing.push_back(
        fmt::format("no SCHED_FIFO ({}): other programs delay ticks by milliseconds; allow it with ulimit -r "
                    "{} or LimitRTPRIO=",
                    std::strerror(errno), kPriority));
  }
}

}  // namespace cartwright::firmware
