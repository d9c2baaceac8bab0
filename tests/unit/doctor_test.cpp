#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "host/doctor/check.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using State = Check::State;
using testing::HasSubstr;

/// A machine made of a few files.
class Doctor : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(system_.root); }
  void put(const std::string& file, const std::string& text) {
    fs::create_directories((system_.root / file).parent_path());
    std::ofstream(system_.root / file) << text << "\n";
  }
  SystemView system_{fs::temp_directory_path() /
                     ("cartwright_doctor_" + std::to_string(::getpid()) +
                      testing::UnitTest::GetInstance()->current_test_info()->name())};
};

TEST_F(Doctor, KnowsARealTimeKernelFromAnOrdinaryOne) {
  put("proc/sys/kernel/osrelease", "6.1.0-rt");
  EXPECT_EQ(check_kernel(system_).state, State::wrong);
  EXPECT_THAT(check_kernel(system_).mend, HasSubstr("linux-image-rt-amd64"));
  put("sys/kernel/realtime", "1");
  EXPECT_EQ(check_kernel(system_).state, State::fine);
  EXPECT_THAT(check_kernel(system_).found, HasSubstr("6.1.0-rt"));
}

TEST_F(Doctor, FindsASlowClock) {
  const std::string directory = "sys/devices/system/clocksource/clocksource0/";
  EXPECT_EQ(check_clock_source(system_).state, State::absent);
  put(directory + "current_clocksource", "tsc");
  EXPECT_EQ(check_clock_source(system_).state, State::fine);
  put(directory + "current_clocksource", "hpet");
  put(directory + "available_clocksource", "hpet acpi_pm");
  EXPECT_THAT(check_clock_source(system_).mend, HasSubstr("tsc=reliable"));
  put(directory + "available_clocksource", "tsc hpet acpi_pm");
  EXPECT_EQ(check_clock_source(system_).state, State::wrong);
  EXPECT_THAT(check_clock_source(system_).mend, HasSubstr("echo tsc"));
}

TEST_F(Doctor, WantsEveryProcessorAtFullSpeed) {
  EXPECT_EQ(check_governor(system_).state, State::fine);
  put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  EXPECT_EQ(check_governor(system_).state, State::fine);
  put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(check_governor(system_).state, State::wrong);
  EXPECT_THAT(check_governor(system_).found, HasSubstr("cpu1 is governed by powersave"));
}

TEST_F(Doctor, FindsCanInterfacesAndWhetherTheyAreUp) {
  put("sys/class/net/eth0/type", "1");
  ASSERT_EQ(check_can(system_).size(), 1u);
  EXPECT_EQ(check_can(system_)[0].state, State::absent);
  put("sys/class/net/can0/type", "280");
  put("sys/class/net/can0/flags", "0x40080");
  put("sys/class/net/vcan1/type", "280");
  put("sys/class/net/vcan1/flags", "0x400c1");
  const auto checks = check_can(system_);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].state, State::wrong);
  EXPECT_EQ(checks[0].mend, "sudo ip link set can0 up type can bitrate 1000000");
  EXPECT_EQ(checks[1].state, State::fine);
}

TEST_F(Doctor, SaysWhatIsAbsent) {
  EXPECT_EQ(check_gpio(system_).state, State::absent);
  EXPECT_EQ(check_sleep_states(system_).state, State::absent);
  put("dev/gpiochip0", "");
  put("dev/cpu_dma_latency", "");
  EXPECT_EQ(check_gpio(system_).state, State::fine);
  EXPECT_EQ(check_sleep_states(system_).state, State::fine);
}

TEST(DoctorPermissions, AreJudgedByWhatTheControllerNeeds) {
  Permissions allowed{80, std::numeric_limits<double>::infinity(), 1e-9};
  EXPECT_EQ(check_priority(allowed).state, State::fine);
  EXPECT_EQ(check_locked_memory(allowed).state, State::fine);
  EXPECT_EQ(check_clock_resolution(allowed).state, State::fine);
  allowed = {0, 8e6, 4e-3};
  EXPECT_THAT(check_priority(allowed).mend, HasSubstr("rtprio"));
  EXPECT_THAT(check_locked_memory(allowed).found, HasSubstr("at most 8.0 MB"));
  EXPECT_EQ(check_clock_resolution(allowed).state, State::wrong);
}

TEST(DoctorPermissions, OfThisProcessCanBeFoundOut) {
  const Permissions here = permissions();
  EXPECT_GT(here.locked_memory_bytes, 0);
  EXPECT_GT(here.clock_resolution_s, 0);
  EXPECT_LE(here.clock_resolution_s, 0.01);
}

}  // namespace
}  // namespace cartwright
