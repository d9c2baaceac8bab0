#include "host/diagnose/observe/two_mass_gain.hpp"

#include <cmath>

namespace cartwright {
namespace {

using P = Parameter;

/// Teeth in contact: their distance is known to a tenth of the reading error.
constexpr double kTeethVariance = 0.01;
constexpr double kStartSpeedOfPair_per_s = 1e3;  // of the reading error: about a centimetre a second
/// A covariance moves no more where a tick changes no variance by more than this part of it.
constexpr double kSteady = 1e-6;

/// Transition over a tick with accelerations linear in the state: to second order, exact enough where
/// everything stiff is left out.
template <typename Matrix>
Matrix transition(const Matrix& rates, double period_s) {
  const Matrix step = rates * period_s;
  return Matrix::Identity() + step + 0.5 * step * step;
}

}  // namespace

TwoMassGain::TwoMassGain(const Model& model, const NoiseModel& noise, double period_s, double damping_per_s,
                         double count_m)
    : decay_(std::exp(-period_s / noise.correlation_time_s)) {
  const double share = model[P::backlash_load_share], damping = model[P::backlash_load_damping_share];
  const double ratio = noise.disturbance_per_reading_per_s2;

  Matrix rates = Matrix::Zero();
  rates(0, 1) = rates(2, 3) = 1;
  rates(1, 1) = -damping * damping_per_s / share;
  rates(1, 4) = 1 / share;
  rates(3, 3) = -(1 - damping) * damping_per_s / (1 - share);
  apart_ = transition(rates, period_s);
  rates(1, 1) = rates(3, 3) = -damping_per_s;
  rates(1, 4) = rates(3, 4) = 1;
  Matrix one_speed = Matrix::Identity();
  one_speed(1, 1) = one_speed(3, 1) = share;
  one_speed(1, 3) = one_speed(3, 3) = 1 - share;
  together_ = transition(rates, period_s) * one_speed;
  apart_.row(4) << 0, 0, 0, 0, decay_;
  together_.row(4) = apart_.row(4);

  disturbance_variance_ = ratio * ratio * (1 - decay_ * decay_);
  // The motor has a disturbance of its own, as large and new every tick.
  motor_variance_ = std::pow(ratio * period_s, 2);
  const double gap = model[P::backlash_gap] / count_m;
  start_ = Matrix::Zero();
  start_.diagonal() << 1, std::pow(kStartSpeedOfPair_per_s, 2), 1 + gap * gap,
      std::pow(kStartSpeedOfPair_per_s, 2), ratio * ratio;
  restart();
}

void TwoMassGain::restart() {
  p_ = start_;
  steady_ = false;
}

TwoMassGain::Gain TwoMassGain::step(bool in_contact) {
  if (steady_ && in_contact == in_contact_) return gain_;
  const Vector before = p_.diagonal();
  const Matrix& f = in_contact ? together_ : apart_;
  p_ = f * p_ * f.transpose();
  p_(4, 4) += disturbance_variance_;
  p_(3, 3) += motor_variance_;
  if (in_contact) {
    const Vector apart = p_.col(2) - p_.col(0);
    p_ -= apart * apart.transpose() / (apart[2] - apart[0] + kTeethVariance);
  }
  const double s = p_(0, 0) + 1;
  const Vector gain = p_.col(0) / s;
  p_ -= gain * p_.row(0);
  p_ = 0.5 * (p_ + p_.transpose().eval());
  steady_ =
      in_contact == in_contact_ && ((p_.diagonal() - before).array().abs() <= kSteady * before.array()).all();
  in_contact_ = in_contact;
  gain_ = {gain[0], gain[1], gain[2], gain[3], gain[4], s};
  return gain_;
}

}  // namespace cartwright
