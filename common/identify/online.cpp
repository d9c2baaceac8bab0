#include "common/identify/online.hpp"

namespace cartwright {

OnlineIdentification::OnlineIdentification(const OnlineSetup& setup)
    : rows_(setup.rows),
      windows_(setup.window_s),
      twin_(setup.rows.period_s, setup.voltage_limit_V),
      terms_(Model(0), false) {}

void OnlineIdentification::restart() noexcept {
  rows_.interrupt();
  windows_.interrupt();
  identifier_.restart();
  monitor_.restart();
  own_ = false;
  twinned_ = given_;
}

void OnlineIdentification::set_model(const PlantTerms& terms) noexcept {
  given_ = terms.beta > 0;
  own_ = false;
  terms_ = terms;
  windows_.interrupt();  // windows that are open hold what the model before made of them
  monitor_.restart();
  twinned_ = twinned_ || given_;
  if (given_) twin_.set_model(terms.beta, terms.viscous, terms.coulomb);
}

void OnlineIdentification::begin(const PidGains& gains) noexcept {
  rows_.interrupt();
  twin_.begin(gains);
}

void OnlineIdentification::end() noexcept {
  rows_.interrupt();
  twin_.end();
}

void OnlineIdentification::tick(double t_s, double y_m, double u_V, double reference_m,
                                double added_V) noexcept {
  OnlineRow row{t_s, y_m, u_V};
  twin_.run(reference_m, added_V, row);
  if (rows_.push(row)) {
    const std::size_t count = windows_.push(rows_.known(), terms_);
    for (std::size_t i = 0; i < count; ++i) {
      if (!windows_.complete(i).without_instrument) identifier_.add(windows_.complete(i));
      if (given_ || own_) monitor_.add(windows_.complete(i));
    }
  }
  if (identifier_.refine()) take_new_estimates();
}

void OnlineIdentification::take_new_estimates() noexcept {
  const OnlineEstimates& now = identifier_.estimates();
  const double gain = now.gain_m_per_s2_V.value, viscous = now.viscous_per_s.value,
               coulomb = now.coulomb_m_per_s2.value;
  twin_.set_model(gain, viscous, coulomb);
  if (!twinned_) identifier_.forget_blocks();
  twinned_ = true;
  if (given_ || own_ || identifier_.blocks() < kOwnModelBlocks || !(gain > 0)) return;
  own_ = true;
  terms_.beta = gain;
  terms_.viscous = viscous;
  terms_.coulomb = coulomb;
  windows_.interrupt();
  monitor_.restart();
}

}  // namespace cartwright
