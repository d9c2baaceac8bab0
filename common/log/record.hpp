#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace cartwright {

/// What the controller writes down at every tick, in the columns' order. NaN where there is nothing to write:
/// a current that no one measures, a truth that no one knows.
struct LogRecord {
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

  double t_s = 0;             ///< controller's clock at the reading; whole nanoseconds
  double r_m = 0;             ///< reference
  double y_m = 0;             ///< encoder reading
  double u_V = 0;             ///< command after the limits, held until the next tick
  double d_V = 0;             ///< voltage added after the control law, before the limits
  double i_A = kNothing;      ///< motor current
  double bus_V = kNothing;    ///< amplifier supply
  double motor_C = kNothing;  ///< motor temperature
  double status = 0;          ///< state, flags and fault: common/wire/codes.hpp
  double limited_by = 0;      ///< wire::Limited
  double missed_ticks = 0;    ///< ticks lost just before this one
  double lateness_s = 0;      ///< wake-up after the deadline
  double truth_y_m = kNothing;
  double truth_v_m_per_s = kNothing;
  double compensation_V = kNothing;        ///< what the friction compensation adds, part of d_V
  double sliding_m_per_s = kNothing;       ///< sliding variable of the adaptive law
  double estimate_a_V_s_per_m = kNothing;  ///< its estimates
  double estimate_b_V_s2_per_m = kNothing;
  double estimate_f1_V = kNothing;
  double estimate_f2_V_s_per_m = kNothing;
  double estimate_f_V = kNothing;
  double identified_gain_m_per_s2_V = kNothing;  ///< identified while running
  double identified_viscous_per_s = kNothing;
  double identified_coulomb_m_per_s2 = kNothing;
  double innovation_m_per_s2 = kNothing;  ///< rms acceleration that the model leaves
};

inline constexpr std::size_t kLogColumns = 25;

/// Names of the columns, as in a recording's CSV.
inline constexpr std::array<std::string_view, kLogColumns> kLogColumnNames{"t_s",
                                                                           "r_m",
                                                                           "y_m",
                                                                           "u_V",
                                                                           "d_V",
                                                                           "i_A",
                                                                           "bus_V",
                                                                           "motor_C",
                                                                           "status",
                                                                           "limited_by",
                                                                           "missed_ticks",
                                                                           "lateness_s",
                                                                           "truth_y_m",
                                                                           "truth_v_m_per_s",
                                                                           "compensation_V",
                                                                           "sliding_m_per_s",
                                                                           "estimate_a_V_s_per_m",
                                                                           "estimate_b_V_s2_per_m",
                                                                           "estimate_f1_V",
                                                                           "estimate_f2_V_s_per_m",
                                                                           "estimate_f_V",
                                                                           "identified_gain_m_per_s2_V",
                                                                           "identified_viscous_per_s",
                                                                           "identified_coulomb_m_per_s2",
                                                                           "innovation_m_per_s2"};

using LogRow = std::array<double, kLogColumns>;

constexpr LogRow to_row(const LogRecord& r) noexcept {
  return {r.t_s,
          r.r_m,
          r.y_m,
          r.u_V,
          r.d_V,
          r.i_A,
          r.bus_V,
          r.motor_C,
          r.status,
          r.limited_by,
          r.missed_ticks,
          r.lateness_s,
          r.truth_y_m,
          r.truth_v_m_per_s,
          r.compensation_V,
          r.sliding_m_per_s,
          r.estimate_a_V_s_per_m,
          r.estimate_b_V_s2_per_m,
          r.estimate_f1_V,
          r.estimate_f2_V_s_per_m,
          r.estimate_f_V,
          r.identified_gain_m_per_s2_V,
          r.identified_viscous_per_s,
          r.identified_coulomb_m_per_s2,
          r.innovation_m_per_s2};
}

/// The names with commas between, as the controller announces them.
inline std::string log_schema() {
  std::string text;
  for (const std::string_view column : kLogColumnNames) text.append(text.empty() ? "" : ",").append(column);
  return text;
}

/// Time since the start of a recording. Clock readings are whole nanoseconds; the difference is rounded to
/// one, so that it prints as short as it is.
inline double since_s(double t_s, double start_s) noexcept {
  return std::round((t_s - start_s) * 1e9) / 1e9;
}

}  // namespace cartwright
