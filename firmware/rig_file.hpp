#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/config/rig.hpp"
#include "common/model/model.hpp"
#include "common/result.hpp"
#include "firmware/settings.hpp"

namespace cartwright::firmware {

/// The rig file of `cartwrightd`: `[rig]` as in session.toml, with more keys, and `[simulation]` for a
/// simulated one.
struct RigFile {
  Rig rig;  ///< name, sample_rate_hz (100 to 4000), encoder_resolution_m, voltage_limit_V, travel_m
  std::string kind = "simulated";
  bool virtual_time = false;     ///< clock = "real" | "virtual"
  bool require_realtime = true;  ///< refuse a real rig without SCHED_FIFO and locked memory
  std::string listen = "127.0.0.1";
  int port = 1502;
  std::filesystem::path gain_file = "gains.txt";  ///< relative to the rig file

  double slew_limit_V_per_s = 5e4;
  double travel_margin_m = 0.01;
  double greatest_speed_m_per_s = 5;
  double host_timeout_s = 2;
  std::uint32_t most_missed_ticks = 20;
  double encoder_stuck_V = 3;  ///< more than this for `encoder_stuck_s` without a count: stuck
  double encoder_stuck_s = 0.25;
  double encoder_oldest_s = 0.005;  ///< readings older than this are encoder_late

  double approach_kp_V_per_m = 60;  ///< gains and speed of the move to where a run starts
  double approach_kd_V_s_per_m = 2;
  double approach_speed_m_per_s = 0.1;

  Settings settings;  ///< registers as they stand at the start: [compensation]

  Model model{1.9};  ///< of the simulated cart
  std::uint64_t seed = 1;
  double start_position_m = 0;
  double end_stop_m = 0.05;  ///< end stops stand this far outside the travel
};

/// Reads the text of a rig file; `source` names it in messages, and model and gain files are found relative
/// to it.
Result<RigFile> rig_file_from_toml(std::string_view text, const std::filesystem::path& source);
Result<RigFile> read_rig_file(const std::filesystem::path& file);

}  // namespace cartwright::firmware
