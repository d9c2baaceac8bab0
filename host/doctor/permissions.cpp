#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <limits>

#include "host/doctor/check.hpp"

namespace cartwright {
namespace {

using State = Check::State;

/// What cartwrightd asks for.
constexpr int kWantedPriority = 80;
/// The controller locks the log ring (10 minutes at 1 kHz, 14 numbers a row: 67 MB) and its program; with
/// room to spare.
constexpr double kWantedLocked_bytes = 256e6;

/// Writes limits that hold after the next login. The systemd unit brings its own.
constexpr const char* kRaiseLimits =
    "printf '%s - rtprio 90\\n%s - memlock unlimited\\n' \"$USER\" \"$USER\" | "
    "sudo tee /etc/security/limits.d/90-cartwright.conf  # then log in again";

/// Asks the kernel in a child process, as limits, capabilities and control groups all have a say.
bool child_may(int (*attempt)()) {
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) ::_exit(attempt());
  int status = 1;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int become_fifo() {
  sched_param parameter{};
  parameter.sched_priority = kWantedPriority;
  return ::sched_setscheduler(0, SCHED_FIFO, &parameter) == 0 ? 0 : 1;
}

int lock_wanted_memory() {
  const auto bytes = static_cast<std::size_t>(kWantedLocked_bytes);
  void* memory = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return 1;
  // On fault: the limit is checked as for mlockall, but no page is taken.
  return ::mlock2(memory, bytes, MLOCK_ONFAULT) == 0 ? 0 : 1;
}

}  // namespace

Permissions permissions() {
  Permissions result;
  rlimit limit{};
  if (child_may(become_fifo)) {
    result.greatest_fifo_priority = kWantedPriority;
  } else if (::getrlimit(RLIMIT_RTPRIO, &limit) == 0) {
    result.greatest_fifo_priority = std::min(static_cast<int>(limit.rlim_cur), kWantedPriority - 1);
  }
  if (child_may(lock_wanted_memory)) {
    result.locked_memory_bytes = std::numeric_limits<double>::infinity();
  } else if (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0) {
    result.locked_memory_bytes = static_cast<double>(limit.rlim_cur);
  }
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  result.clock_resolution_s =
      static_cast<double>(resolution.tv_sec) + 1e-9 * static_cast<double>(resolution.tv_nsec);
  return result;
}

Check check_priority(const Permissions& permissions) {
  if (permissions.greatest_fifo_priority >= kWantedPriority) {
    return {"real-time priority", State::fine, fmt::format("SCHED_FIFO {} is permitted", kWantedPriority),
            ""};
  }
  const std::string permitted = permissions.greatest_fifo_priority <= 0
                                    ? std::string("is not permitted")
                                    : fmt::format("only up to {}", permissions.greatest_fifo_priority);
  return {"real-time priority", State::wrong,
          fmt::format("SCHED_FIFO {} {}: any other program can delay a tick", kWantedPriority, permitted),
          kRaiseLimits};
}

Check check_locked_memory(const Permissions& permissions) {
  if (permissions.locked_memory_bytes >= kWantedLocked_bytes) {
    return {"locked memory", State::fine, fmt::format("{:.0f} MB may be locked", kWantedLocked_bytes / 1e6),
            ""};
  }
  return {"locked memory", State::wrong,
          fmt::format("at most {:.1f} MB may be locked, {:.0f} MB are needed: a page fault can delay a tick",
                      permissions.locked_memory_bytes / 1e6, kWantedLocked_bytes / 1e6),
          kRaiseLimits};
}

Check check_clock_resolution(const Permissions& permissions) {
  constexpr double kCoarsest_s = 1e-6;
  const std::string found = fmt::format("{:.0f} ns", permissions.clock_resolution_s * 1e9);
  if (permissions.clock_resolution_s <= kCoarsest_s) return {"clock resolution", State::fine, found, ""};
  return {"clock resolution", State::wrong, found + ": the kernel runs without high-resolution timers",
          "sudo sed -i 's/^GRUB_CMDLINE_LINUX=\"/&highres=on /' /etc/default/grub && sudo update-grub && "
          "sudo reboot"};
}

}  // namespace cartwright
