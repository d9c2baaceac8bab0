#pragma once

#include <functional>
#include <memory>

#include "firmware/controller.hpp"
#include "firmware/loop.hpp"
#include "hal/sim/simulated_cart.hpp"

namespace cartwright::firmware {

/// The usual cart of these tests, its Coulomb friction times `friction`.
inline Model cart(double friction = 1) {
  return Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5 * friction);
}

/// A whole controller on a simulated cart in virtual time, driven tick by tick from a test.
class TestRig {
 public:
  static constexpr std::int64_t kPeriod_ns = 1'000'000;

  explicit TestRig(const Model& model = firmware::cart());
  TestRig(const Model& model, const RigFile& file, std::size_t log_rows = 100'000);

  void ticks(int count) {
    for (int i = 0; i < count; ++i) loop.tick();
  }

  bool command(wire::Command command, const Programme& programme = {}, const PidGains& gains = {}) {
    auto request = std::make_unique<Request>();
    request->sequence = ++sequence;
    request->command = command;
    request->programme = programme;
    request->gains = gains;
    exchange->requests.post(*request);
    loop.tick();
    return status().ack_sequence == sequence && status().ack == wire::Ack::done;
  }

  bool arm() {
    loop.tick();
    return command(wire::Command::arm);
  }

  Programme one(std::function<void(Settings&)> set_up) {
    Settings settings;
    set_up(settings);
    return prepare(settings, rig).value();
  }

  bool start(const Programme& programme) { return arm() && command(wire::Command::run, programme); }

  /// Ticks until the experiment is over; false when that takes longer than `most`.
  bool finish(int most = 200'000) {
    for (int i = 0; i < most && controller.state() == wire::State::running; ++i) loop.tick();
    return controller.state() != wire::State::running;
  }

  const Status& status() const { return controller.status(); }
  RecordingEntry recording(std::size_t i) const { return exchange->recordings[i].read(); }

  std::vector<LogRow> rows(std::uint64_t first, std::size_t count) const {
    std::vector<LogRow> out(count);
    out.resize(exchange->log.copy(first, out));
    return out;
  }
  std::vector<LogRow> rows_of(std::size_t i) const {
    const RecordingEntry entry = recording(i);
    return rows(entry.first_row, entry.rows);
  }
  LogRow last_row() const { return rows(exchange->log.rows() - 1, 1).front(); }

  std::int64_t now_ns() { return pacer.now_ns(); }

  RigFile rig;
  hal::sim::SimulatedCart cart;
  std::unique_ptr<Exchange> exchange;
  Controller controller;
  VirtualPacer pacer;
  Telemetry telemetry;
  Loop loop;
  std::uint16_t sequence = 0;
};

/// Columns of a LogRow, by name.
namespace column {
inline constexpr std::size_t t = 0, r = 1, y = 2, u = 3, d = 4, status = 8, limited = 9, missed = 10,
                             truth_y = 12, truth_v = 13;
}

}  // namespace cartwright::firmware
