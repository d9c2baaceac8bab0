#include "host/diagnose/observe/two_mass_gain.hpp"

#include <cmath>

namespace cartwright {
namespace {

using P = Parameter;

/// Teeth in contact: their distance is known to a tenth of the reading error.
constexpr double kTeethVariance = 0.01;
constexpr double kStartSpeedOfPair_per_s = 1e3;  // of the reading error: about a centimetre a second
/// A covariance moves no more where a tick changes no variance by more than this part of it.
constexpr double kSteady = 1e-5;

/// Where each of the state is: positions first, which only speeds and the disturbance move.
enum State { y, y_motor, v, v_motor, d };

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
  rates(y, v) = rates(y_motor, v_motor) = 1;
  rates(v, v) = -damping * damping_per_s / share;
  rates(v, d) = 1 / share;
  rates(v_motor, v_motor) = -(1 - damping) * damping_per_s / (1 - share);
  const Matrix apart = transition(rates, period_s);
  rates(v, v) = rates(v_motor, v_motor) = -damping_per_s;
  rates(v, d) = rates(v_motor, d) = 1;
  Matrix one_speed = Matrix::Identity();
  one_speed(v, v) = one_speed(v_motor, v) = share;
  one_speed(v, v_motor) = one_speed(v_motor, v_motor) = 1 - share;
  const Matrix together = transition(rates, period_s) * one_speed;
  apart_ = apart.middleCols<3>(v);
  together_ = together.middleCols<3>(v);
  apart_(d, 2) = together_(d, 2) = decay_;

  disturbance_variance_ = ratio * ratio * (1 - decay_ * decay_);
  // The motor has a disturbance of its own, as large and new every tick.
  motor_variance_ = std::pow(ratio * period_s, 2);
  const double gap = model[P::backlash_gap] / count_m;
  start_ = Matrix::Zero();
  start_.diagonal() << 1, 1 + gap * gap, std::pow(kStartSpeedOfPair_per_s, 2),
      std::pow(kStartSpeedOfPair_per_s, 2), ratio * ratio, 0;
  restart();
}

void TwoMassGain::restart() {
  p_ = start_;
  steady_ = false;
}

TwoMassGain::Gain TwoMassGain::step(bool in_contact) {
  if (steady_ && in_contact == in_contact_) return gain_;
  const Vector before = p_.diagonal();
  const Movers& f = in_contact ? together_ : apart_;
  Matrix half = f * p_.middleRows<3>(v);
  half.topRows<2>() += p_.topRows<2>();
  p_ = half.middleCols<3>(v) * f.transpose();
  p_.leftCols<2>() += half.leftCols<2>();
  p_(d, d) += disturbance_variance_;
  p_(v_motor, v_motor) += motor_variance_;
  if (in_contact) {
    const Vector apart = p_.col(y_motor) - p_.col(y);
    p_ -= apart * apart.transpose() / (apart[y_motor] - apart[y] + kTeethVariance);
  }
  const double s = p_(y, y) + 1;
  const Vector gain = p_.col(y) / s;
  p_ -= gain * p_.col(y).transpose();
  p_ = 0.5 * (p_ + p_.transpose().eval());
  steady_ =
      in_contact == in_contact_ && ((p_.diagonal() - before).array().abs() <= kSteady * before.array()).all();
  in_contact_ = in_contact;
  gain_ = {gain[y], gain[v], gain[y_motor], gain[v_motor], gain[d], s};
  return gain_;
}

}  // namespace cartwright
