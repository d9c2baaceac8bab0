#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cartwright {

/// One thing that decides how well a controller can keep its time, or whether it finds its devices.
struct Check {
  enum class State {
    fine,
    absent,  ///< not there, and only some rigs need it
    wrong,
  };
  std::string name;
  State state;
  std::string found;  ///< what is so, and what it costs where it is wrong
  std::string mend;   ///< the command that mends it; empty where nothing is wrong
};

/// Where to look. Tests look at a tree of their own.
struct SystemView {
  std::filesystem::path root = "/";
};

// From files of the kernel.
Check check_kernel(const SystemView& system);
Check check_clock_source(const SystemView& system);
Check check_sleep_states(const SystemView& system);
Check check_governor(const SystemView& system);
std::vector<Check> check_can(const SystemView& system);
Check check_gpio(const SystemView& system);

/// What this process may do; cartwrightd started from the same shell may do the same.
struct Permissions {
  int greatest_fifo_priority = 0;  ///< 0: none
  double locked_memory_bytes = 0;  ///< infinite where unlimited
  double clock_resolution_s = 0;   ///< of the monotonic clock
};
Permissions permissions();

Check check_priority(const Permissions& permissions);
Check check_locked_memory(const Permissions& permissions);
Check check_clock_resolution(const Permissions& permissions);

}  // namespace cartwright
