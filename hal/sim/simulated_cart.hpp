#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"
#include "hal/interface/stage.hpp"
#include "hal/sim/faults.hpp"

namespace cartwright::hal::sim {

struct CartSetup {
  Model model{1.9};
  double encoder_resolution_m = 2.275e-5;
  double amplifier_limit_V = 12;  ///< what the amplifier can deliver, whatever is asked of it
  double low_end_m = -0.45;       ///< end stops: switches, and hard walls a little behind them
  double high_end_m = 0.45;
  double start_position_m = 0;
  double plant_step_s = 2.5e-4;
  std::uint64_t seed = 1;
};

/// The simulated cart behind the device interfaces: one plant, looked at through an encoder and pushed by an
/// amplifier. The plant is advanced to the time of each reading under the command that was last written, so
/// that the devices behave the same on a real and on a virtual clock. Nothing allocates after construction.
class SimulatedCart final : public Encoder, public Amplifier, public DigitalInputs, public SimulationOnly {
 public:
  explicit SimulatedCart(const CartSetup& setup, const Faults& faults = {});

  void read(const Tick& tick, Measurement& measurement) noexcept override;
  double resolution_m() const noexcept override { return setup_.encoder_resolution_m; }
  void report(const Tick& tick, AmplifierReport& report) noexcept override;
  void write(const Tick& tick, const Command& command) noexcept override;
  void read(const Tick& tick, Inputs& inputs) noexcept override;
  Truth truth() const noexcept override;
  void recording_started(std::string_view file) noexcept override;

  /// Changes what is broken; takes effect at the next call. For tests, between ticks.
  void set_faults(const Faults& faults) noexcept { faults_ = faults; }
  /// Another cart from now on, where this one is: friction that grows, a payload. For tests, between ticks.
  void set_model(const Model& model);
  Devices devices() noexcept { return {this, this, this, this}; }
  /// The voltage that drives the plant now.
  double delivered_V() const noexcept { return delivered_V_; }

 private:
  struct Reading {
    double position_m;
    std::int64_t timestamp_ns;
    std::uint32_t sequence;
  };
  static constexpr std::size_t kHistory = 64;

  void advance_to(std::int64_t now_ns) noexcept;
  void stop_at_walls() noexcept;
  Reading reading_before(std::int64_t time_ns) const noexcept;

  CartSetup setup_;
  Faults faults_;
  Plant plant_;
  cartwright::Encoder encoder_;
  std::int64_t start_ns_ = -1, now_ns_ = 0, read_ns_ = 0;
  Command command_, next_command_;
  double delivered_V_ = 0;
  std::array<Reading, kHistory> history_{};
  std::size_t readings_ = 0;
  Measurement last_;
};

}  // namespace cartwright::hal::sim
