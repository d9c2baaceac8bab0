// Replaces malloc's entry points for this program: any allocation while a tick is under way is counted.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/sim/rig.hpp"

namespace {

std::atomic<bool> in_tick{false};
std::atomic<long> counted{0};

void* allocate(std::size_t size) {
  if (in_tick.load()) ++counted;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void give_back(void* memory) {
  if (in_tick.load()) ++counted;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete[](void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  give_back(memory);
}

namespace cartwright::firmware {
namespace {

TEST(AllocationGuard, SeesAnAllocation) {
  in_tick = true;
  ::operator delete(::operator new(1));  // called by name: the compiler may drop a pair of expressions
  in_tick = false;
  EXPECT_GE(counted.exchange(0), 1);
}

TEST(AllocationGuard, NoTickOfABatteryOfAFaultOrOfAChangeOfGainsOrCompensationAllocates) {
  Model model = cart();
  model.set(Parameter::transport_delay, 2e-3).set(Parameter::missed_rate, 1).set(Parameter::missed_burst, 2);
  model.set(Parameter::missed_speed, 0.1);
  RigFile file;
  put_model(file.settings, cart());
  file.settings.set(wire::Id::compensation_mode, 2);
  TestRig rig(model, file, 200'000);
  const auto standard = std::make_unique<Programme>(battery(rig.rig));
  const auto guarded = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      in_tick = true;
      rig.loop.tick();
      in_tick = false;
    }
  };
  const auto guarded_command = [&](wire::Command command) {
    auto request = std::make_unique<Request>();
    request->command = command;
    request->programme = *standard;
    request->gains = {50, 1, 50, false};
    request->compensation = *compensation_from(rig.rig.settings, rig.rig);
    rig.exchange->requests.post(*request);
    guarded(1);
  };
  guarded(10);
  guarded_command(wire::Command::arm);
  guarded_command(wire::Command::run);
  while (rig.controller.state() == wire::State::running) guarded(100);
  EXPECT_EQ(rig.status().outcome, wire::Outcome::finished);
  EXPECT_GT(rig.status().identified.windows, 0U) << "the identification was at work";
  guarded_command(wire::Command::run);
  guarded(1000);
  guarded_command(wire::Command::activate_gains);
  guarded_command(wire::Command::set_compensation);
  guarded(10);
  guarded_command(wire::Command::restart_identification);
  hal::sim::Faults faults;
  faults.emergency_stop_ns = 0;
  rig.cart.set_faults(faults);
  guarded(10);
  EXPECT_EQ(rig.controller.state(), wire::State::faulted);
  rig.cart.set_faults({});
  guarded_command(wire::Command::reset);
  EXPECT_EQ(rig.controller.state(), wire::State::disarmed);
  EXPECT_EQ(counted.load(), 0);
}

}  // namespace
}  // namespace cartwright::firmware
