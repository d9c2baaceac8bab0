#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "host/doctor/check.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using State = Check::State;

/// The first line of a file; empty where there is none.
std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// Entries of a directory whose names start with `prefix`, in order.
std::vector<fs::path> entries(const fs::path& directory, std::string_view prefix) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(directory, none)) {
    if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool may_use(const fs::path& device) {
  return ::access(device.c_str(), R_OK | W_OK) == 0;
}

}  // namespace

Check check_kernel(const SystemView& system) {
  const std::string release = first_line(system.root / "proc/sys/kernel/osrelease");
  if (first_line(system.root / "sys/kernel/realtime") == "1") {
    return {"kernel", State::fine, fmt::format("Linux {} with PREEMPT_RT", release), ""};
  }
  return {
      "kernel", State::wrong,
      fmt::format("Linux {} without PREEMPT_RT: a busy machine can delay a tick by milliseconds", release),
      "sudo apt-get install linux-image-rt-amd64 && sudo reboot"};
}

Check check_clock_source(const SystemView& system) {
  const fs::path directory = system.root / "sys/devices/system/clocksource/clocksource0";
  const std::string current = first_line(directory / "current_clocksource");
  if (current.empty())
    return {"clock source", State::absent, "the kernel does not name its clock source", ""};
  const auto slow = {"hpet", "acpi_pm", "jiffies", "refined-jiffies", "pit"};
  if (std::find(slow.begin(), slow.end(), current) == slow.end()) {
    return {"clock source", State::fine, current, ""};
  }
  const std::string available = " " + first_line(directory / "available_clocksource") + " ";
  const std::string cost =
      fmt::format("{}: reading the time takes a microsecond or more, twice a tick", current);
  if (available.find(" tsc ") != std::string::npos) {
    return {"clock source", State::wrong, cost,
            "echo tsc | sudo tee /sys/devices/system/clocksource/clocksource0/current_clocksource"};
  }
  return {"clock source", State::wrong, cost + "; the kernel distrusts the faster one",
          "sudo sed -i 's/^GRUB_CMDLINE_LINUX=\"/&tsc=reliable /' /etc/default/grub && sudo update-grub && "
          "sudo reboot"};
}

Check check_sleep_states(const SystemView& system) {
  const fs::path device = system.root / "dev/cpu_dma_latency";
  std::error_code none;
  if (!fs::exists(device, none)) {
    return {"processor sleep", State::absent,
            "no /dev/cpu_dma_latency: this machine does not let programs limit it", ""};
  }
  if (::access(device.c_str(), W_OK) == 0) {
    return {"processor sleep", State::fine,
            "/dev/cpu_dma_latency may be held, the processor stays awake between ticks", ""};
  }
  return {
      "processor sleep", State::wrong,
      "/dev/cpu_dma_latency may not be written: waking from deep sleep can take 100 us or more",
      "echo 'KERNEL==\"cpu_dma_latency\", MODE=\"0666\"' | sudo tee /etc/udev/rules.d/90-cartwright.rules && "
      "sudo chmod 0666 /dev/cpu_dma_latency"};
}

Check check_governor(const SystemView& system) {
  std::string slow;
  int governed = 0;
  for (const fs::path& cpu : entries(system.root / "sys/devices/system/cpu", "cpu")) {
    const std::string governor = first_line(cpu / "cpufreq/scaling_governor");
    if (governor.empty()) continue;
    ++governed;
    if (governor != "performance")
      slow = fmt::format("{} is governed by {}", cpu.filename().string(), governor);
  }
  if (governed == 0) return {"processor speed", State::fine, "fixed: no frequency scaling here", ""};
  if (slow.empty()) {
    return {"processor speed", State::fine, fmt::format("performance on all {} processors", governed), ""};
  }
  return {"processor speed", State::wrong, slow + ": a tick after a quiet time runs slowly",
          "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor"};
}

std::vector<Check> check_can(const SystemView& system) {
  constexpr std::string_view kCanHardware = "280";  // ARPHRD_CAN
  constexpr unsigned kUp = 1;                       // IFF_UP
  std::vector<Check> checks;
  for (const fs::path& interface : entries(system.root / "sys/class/net", "")) {
    if (first_line(interface / "type") != kCanHardware) continue;
    const std::string name = interface.filename().string();
    const unsigned long flags = std::strtoul(first_line(interface / "flags").c_str(), nullptr, 16);
    if ((flags & kUp) != 0) {
      checks.push_back({"CAN", State::fine, name + " is up", ""});
      continue;
    }
    const bool is_virtual = name.starts_with("v");
    checks.push_back({"CAN", State::wrong, name + " is down",
                      is_virtual ? fmt::format("sudo ip link set {} up", name)
                                 : fmt::format("sudo ip link set {} up type can bitrate 1000000", name)});
  }
  if (checks.empty())
    checks.push_back({"CAN", State::absent, "no interface; only a CAN amplifier needs one", ""});
  return checks;
}

Check check_gpio(const SystemView& system) {
  const auto chips = entries(system.root / "dev", "gpiochip");
  if (chips.empty()) return {"GPIO", State::absent, "no chip; only an encoder on GPIO lines needs one", ""};
  for (const fs::path& chip : chips) {
    if (!may_use(chip)) {
      return {"GPIO", State::wrong, fmt::format("/dev/{} may not be used", chip.filename().string()),
              "sudo groupadd -f gpio && echo 'SUBSYSTEM==\"gpio\", GROUP=\"gpio\", MODE=\"0660\"' | "
              "sudo tee /etc/udev/rules.d/91-cartwright-gpio.rules && sudo udevadm control --reload && "
              "sudo udevadm trigger --subsystem-match=gpio && sudo usermod -aG gpio \"$USER\"  # then log in "
              "again"};
    }
  }
  return {"GPIO", State::fine, fmt::format("{} chips may be used", chips.size()), ""};
}

}  // namespace cartwright
