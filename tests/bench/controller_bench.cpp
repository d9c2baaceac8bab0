// What a tick costs and how much faster than real time the simulated loop runs. Ticks are timed one by one,
// because a mean hides the tail that a deadline meets.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "firmware/controller.hpp"
#include "firmware/loop.hpp"
#include "hal/sim/simulated_cart.hpp"

namespace cartwright::firmware {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

/// Devices that cost nothing: the controller's own share of a tick is what is left.
class NoDevices final : public hal::Encoder, public hal::Amplifier, public hal::DigitalInputs {
 public:
  void read(const hal::Tick& tick, hal::Measurement& m) noexcept override {
    ++count_;
    m = {2.275e-5 * static_cast<double>(count_ % 64), tick.now_ns, 0, count_, hal::Validity::valid};
  }
  double resolution_m() const noexcept override { return 2.275e-5; }
  void report(const hal::Tick&, hal::AmplifierReport& report) noexcept override {
    report.health = hal::AmplifierHealth::good;
  }
  void write(const hal::Tick&, const hal::Command& command) noexcept override {
    benchmark::DoNotOptimize(command);
  }
  void read(const hal::Tick&, hal::Inputs& inputs) noexcept override {
    inputs = {false, false, false, hal::Validity::valid};
  }

 private:
  std::uint32_t count_ = 0;
};

void start(Exchange& exchange, Loop& loop, const Programme& programme) {
  auto request = std::make_unique<Request>();
  loop.tick();
  for (const wire::Command command : {wire::Command::arm, wire::Command::run}) {
    request->command = command;
    request->programme = programme;
    exchange.requests.post(*request);
    loop.tick();
  }
}

Programme long_track(const RigFile& rig) {
  Settings settings;
  settings.set(wire::Id::experiment_kind, 3);
  settings.set(wire::Id::experiment_duration_s, 600);
  return *prepare(settings, rig);
}

double part(std::vector<double>& sorted, double p) {
  return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size() - 1))];
}

/// Law, supervisor, log and publication of one tick of a ten-line multisine track, devices left out.
void controller_tick(benchmark::State& bench) {
  RigFile rig;
  rig.rig.encoder_resolution_m = 2.275e-5;
  NoDevices none;
  const auto exchange = std::make_unique<Exchange>(600'000);
  Controller controller(controller_setup(rig), {&none, &none, &none, nullptr}, *exchange);
  VirtualPacer pacer;
  Telemetry telemetry;
  Loop loop(controller, pacer, kPeriod_ns, telemetry);
  const Programme programme = long_track(rig);
  std::vector<double> took_us;
  took_us.reserve(2'000'000);
  hal::Tick tick{0, kPeriod_ns};
  for (auto _ : bench) {
    if (controller.state() != wire::State::running) {
      start(*exchange, loop, programme);
      tick.now_ns = pacer.now_ns();
    }
    tick.now_ns += kPeriod_ns;
    const auto before = std::chrono::steady_clock::now();
    controller.tick(tick, 0, 0);
    const auto after = std::chrono::steady_clock::now();
    if (took_us.size() < took_us.capacity()) {
      took_us.push_back(std::chrono::duration<double, std::micro>(after - before).count());
    }
  }
  std::sort(took_us.begin(), took_us.end());
  bench.counters["median_us"] = part(took_us, 0.5);
  bench.counters["p99_us"] = part(took_us, 0.99);
  bench.counters["p999_us"] = part(took_us, 0.999);
  bench.counters["p999_over_2us"] = part(took_us, 0.999) / 2;
}
BENCHMARK(controller_tick)->Iterations(1'000'000)->Unit(benchmark::kMicrosecond);

/// The battery on the simulated cart, simulated seconds over seconds taken.
void closed_loop(benchmark::State& bench) {
  RigFile rig;
  rig.rig.encoder_resolution_m = 2.275e-5;
  hal::sim::CartSetup setup;
  setup.model = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
  const Programme programme = battery(rig);
  double simulated_s = 0;
  for (auto _ : bench) {
    bench.PauseTiming();
    hal::sim::SimulatedCart cart(setup);
    const auto exchange = std::make_unique<Exchange>(150'000);
    Controller controller(controller_setup(rig), cart.devices(), *exchange);
    VirtualPacer pacer;
    Telemetry telemetry;
    Loop loop(controller, pacer, kPeriod_ns, telemetry);
    start(*exchange, loop, programme);
    bench.ResumeTiming();
    while (controller.state() == wire::State::running) loop.tick();
    simulated_s += static_cast<double>(pacer.now_ns()) * 1e-9;
  }
  bench.counters["times_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}
BENCHMARK(closed_loop)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cartwright::firmware

BENCHMARK_MAIN();
