#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <variant>

#include "common/identify/online.hpp"
#include "firmware/exchange/log_ring.hpp"
#include "firmware/exchange/mailbox.hpp"
#include "firmware/exchange/published.hpp"
#include "firmware/output_stage.hpp"
#include "firmware/status.hpp"
#include "firmware/supervisor.hpp"
#include "hal/interface/stage.hpp"

namespace cartwright::firmware {

/// What a controller shares with other threads. The loop writes status, recordings and log; requests come in.
struct Exchange {
  static constexpr std::size_t kMostRecordings = 64;

  explicit Exchange(std::size_t log_rows) : log(log_rows) {}

  Published<Status> status;
  std::array<Published<RecordingEntry>, kMostRecordings> recordings;
  LogRing log;
  Mailbox<Request> requests;
  std::atomic<bool> host_lost{false};
};

struct ControllerSetup {
  double period_s = 1e-3;
  double voltage_limit_V = 12, slew_limit_V_per_s = 5e4;
  Bounds bounds;
  PidGains gains{{60, 0, 50, false}, 0};  ///< active at the start
  CompensationSetup compensation;         ///< active at the start
  double approach_kp_V_per_m = 60, approach_kd_V_s_per_m = 2, approach_speed_m_per_s = 0.1;
};

ControllerSetup controller_setup(const RigFile& rig);

/// Everything that happens in one tick: read the devices, obey a request, supervise, run the experiment
/// through its control law, shape the output, write it, log it, show it. No allocation, lock, exception or
/// system call.
class Controller {
 public:
  Controller(const ControllerSetup& setup, const hal::Devices& devices, Exchange& exchange);

  /// `lateness_s` is the wake-up's, `missed` the ticks lost just before this one.
  void tick(const hal::Tick& tick, double lateness_s, std::uint32_t missed) noexcept;

  wire::State state() const noexcept { return status_.state; }
  const Status& status() const noexcept { return status_; }

 private:
  enum class Phase { approach, record };
  struct Wanted {
    double reference_m = 0, added_V = 0, voltage_V = 0;
  };

  bool recording() const noexcept { return status_.state == wire::State::running && phase_ == Phase::record; }
  void obey(const Request& request) noexcept;
  wire::Reason carry_out(const Request& request) noexcept;
  wire::Reason arm() noexcept;
  void start(const Programme& programme) noexcept;
  void change_gains(const PidGains& gains) noexcept;
  void change_compensation(const CompensationSetup& setup) noexcept;
  void take_new_gains(const Wanted& wanted, double y_m) noexcept;
  double compensation_V(Run& run, double time_s, const Wanted& wanted, double y_m) noexcept;

  Wanted run(double y_m) noexcept;
  Wanted approach(double y_m) noexcept;
  Wanted record(double y_m) noexcept;
  void begin_run(double y_m) noexcept;
  void begin_recording() noexcept;
  void end_recording(wire::Outcome outcome) noexcept;
  void next_run(wire::Outcome outcome) noexcept;
  void finish(wire::Outcome outcome) noexcept;
  void latch(const FaultReport& report) noexcept;
  void log(const hal::Tick& tick, double lateness_s, std::uint32_t missed, const Wanted& wanted,
           double output_V) noexcept;
  void identify(const hal::Tick& tick, const Wanted& wanted, double output_V) noexcept;
  void take_notice() noexcept;
  void show(const Wanted& wanted, double output_V) noexcept;

  ControllerSetup setup_;
  hal::Devices devices_;
  Exchange& exchange_;
  OutputStage output_;
  Supervisor supervisor_;
  Status status_;
  Readings readings_;
  double last_output_V_ = 0;
  std::int64_t start_ns_ = -1;

  Programme programme_;
  Phase phase_ = Phase::approach;
  std::size_t run_ = 0;
  std::uint64_t phase_tick_ = 0;
  double approach_from_m_ = 0, approach_s_ = 0, done_s_ = 0, total_s_ = 0;
  PdController approach_law_;
  PidController pd_law_;  ///< PD where Ki is zero
  DualRelayController relay_law_;
  double bump_decay_, bump_V_ = 0;  ///< what bumpless transfer still adds
  bool relay_active_ = false, gains_follow_ = false, gains_pending_ = false, gains_changed_ = false;
  Compensation compensation_;
  OnlineIdentification online_;
  std::uint32_t first_recording_ = 0;
  RecordingEntry entry_;
};

}  // namespace cartwright::firmware
