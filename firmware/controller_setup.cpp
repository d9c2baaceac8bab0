#include "firmware/controller.hpp"

namespace cartwright::firmware {

ControllerSetup controller_setup(const RigFile& file) {
  ControllerSetup setup;
  setup.period_s = file.rig.period_s();
  setup.voltage_limit_V = file.rig.voltage_limit_V;
  setup.slew_limit_V_per_s = file.slew_limit_V_per_s;
  setup.bounds.travel_low_m = file.rig.travel_m[0] + file.travel_margin_m;
  setup.bounds.travel_high_m = file.rig.travel_m[1] - file.travel_margin_m;
  setup.bounds.resolution_m = file.rig.encoder_resolution_m;
  setup.bounds.greatest_speed_m_per_s = file.greatest_speed_m_per_s;
  setup.bounds.stuck_V = file.encoder_stuck_V;
  setup.bounds.stuck_s = file.encoder_stuck_s;
  setup.bounds.oldest_s = file.encoder_oldest_s;
  setup.bounds.host_timeout_s = file.host_timeout_s;
  setup.bounds.most_missed_ticks = file.most_missed_ticks;
  setup.approach_kp_V_per_m = file.approach_kp_V_per_m;
  setup.approach_kd_V_s_per_m = file.approach_kd_V_s_per_m;
  setup.approach_speed_m_per_s = file.approach_speed_m_per_s;
  // The rig file was refused if these do not fit together.
  if (const auto compensation = compensation_from(file.settings, file)) setup.compensation = *compensation;
  return setup;
}

}  // namespace cartwright::firmware
