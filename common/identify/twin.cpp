#include "common/identify/twin.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

constexpr double kMemory_s = 2;
/// A twin that stays apart for longer is of no use, and keeps no rows back any more.
constexpr double kPatience_s = 20;
constexpr double kGreatestDistance = 0.15;  // as offline: host/identify/problem.cpp

}  // namespace

Twin::Twin(double period_s, double voltage_limit_V)
    : period_s_(period_s),
      voltage_limit_V_(voltage_limit_V),
      plant_(Model(0)),
      law_({}, period_s, voltage_limit_V) {}

void Twin::set_model(double gain, double viscous_per_s, double coulomb_m_per_s2) noexcept {
  modelled_ = gain > 0;
  Plant next(Model(gain)
                 .set(Parameter::viscous_coefficient, std::max(0.0, viscous_per_s))
                 .set(Parameter::coulomb_level, std::max(0.0, coulomb_m_per_s2)));
  next.reset(plant_.state());
  plant_ = next;
}

void Twin::begin(const PidGains& gains) noexcept {
  law_ = PidController(gains, period_s_, voltage_limit_V_);
  running_ = first_ = true;
}

void Twin::run(double reference_m, double added_V, OnlineRow& row) noexcept {
  if (!running_) return;
  if (first_) {
    plant_.reset(row.y_m);
    middle_m_ = row.y_m;
    apart_m2_ = moved_m2_ = apart_s_ = 0;
    first_ = false;
  }
  const PlantState& state = plant_.state();
  const double share = period_s_ / kMemory_s;
  const double apart_m = state.position_m - row.y_m;
  middle_m_ += share * (row.y_m - middle_m_);
  const double moved_m = row.y_m - middle_m_;
  apart_m2_ += share * (apart_m * apart_m - apart_m2_);
  moved_m2_ += share * (moved_m * moved_m - moved_m2_);
  row.twin = modelled_ && apart_m2_ < kGreatestDistance * kGreatestDistance * moved_m2_;
  apart_s_ = row.twin ? 0 : apart_s_ + period_s_;
  row.left_out = modelled_ && !row.twin && apart_s_ < kPatience_s;
  row.twin_y_m = state.position_m;
  row.twin_v_m_per_s = state.velocity_m_per_s;
  row.twin_u_V = law_.update(reference_m, state.position_m, added_V);
  if (modelled_) plant_.advance(row.twin_u_V, period_s_);
}

}  // namespace cartwright
