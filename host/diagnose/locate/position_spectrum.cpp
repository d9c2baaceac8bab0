#include "host/diagnose/locate/position_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/fit/influence.hpp"
#include "host/diagnose/observe/rest.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

constexpr double kStepsPerLobe = 2.5;  // lobes of the spectrum over position are 1/travel wide
/// The finest period looked for is this many encoder counts, and crossed in no less than so many ticks.
constexpr double kLeastCounts = 40;
constexpr std::size_t kMostFrequencies = 400;   // in a session of so many rows or more:
constexpr std::size_t kRowsOfASession = 70000;  // shorter ones can afford more

/// So many neighbouring waves are made from one another by turning sine and cosine on.
constexpr std::size_t kTurnedOn = 16;

/// sin and cos of k y for every row of a session.
struct SineAndCosine {
  std::vector<double> sine, cosine;

  SineAndCosine(const Session& session, double wavenumber) {
    for (const Recording& r : session.recordings) {
      for (const double y_m : r.y_m) {
        sine.push_back(std::sin(wavenumber * y_m));
        cosine.push_back(std::cos(wavenumber * y_m));
      }
    }
  }
  void turn(const SineAndCosine& by) {
    for (std::size_t k = 0; k < sine.size(); ++k) {
      const double s = sine[k], c = cosine[k];
      sine[k] = s * by.cosine[k] + c * by.sine[k];
      cosine[k] = c * by.cosine[k] - s * by.sine[k];
    }
  }
};

/// What waves over the way do to the errors of a session, as columns.
class WaveColumns {
 public:
  WaveColumns(const Session& session, const Fit& base, const FitOptions& options)
      : session_(session),
        gains_(observer_gains(base.noise, session.rig.period_s(), options.damping_per_s)),
        damping_per_s_(options.damping_per_s),
        rests_(rows_at_rest(session, options.rest_s)) {
    ObserverOptions keep;
    keep.keep_states = true;
    for (Observation& seen : observe(base.model, gains_, session, keep, options.threads))
      velocity_.push_back(std::move(seen.velocity_m_per_s));
  }

  /// Sine and cosine of a push and, with four lanes, of the reading.
  template <int kLanes>
  void fill(const SineAndCosine& wave, Eigen::MatrixXd& columns) const {
    using Lanes = Eigen::Array<double, kLanes, 1>;
    const std::size_t skip = settling_rows(session_.rig);
    Eigen::Index row = 0;
    std::size_t first = 0;
    for (std::size_t n = 0; n < session_.recordings.size(); ++n) {
      const std::size_t rows = session_.recordings[n].size();
      Influences<Lanes> influences(gains_, session_.rig.period_s(), damping_per_s_);
      Lanes push = Lanes::Zero(), reading = Lanes::Zero();
      for (std::size_t k = 1; k < rows; ++k) {
        const std::size_t at = first + k;
        const bool stuck = velocity_[n][k] == 0;
        push[0] = stuck ? 0 : wave.sine[at - 1];
        push[1] = stuck ? 0 : wave.cosine[at - 1];
        if constexpr (kLanes == 4) reading[2] = wave.sine[at], reading[3] = wave.cosine[at];
        const Lanes e = influences.step(k, push, reading);
        if (k < skip) continue;
        if (rests_[n][k]) {
          columns.row(row++).setZero();
        } else {
          columns.row(row++) = e.matrix().transpose();
        }
      }
      first += rows;
    }
  }

 private:
  const Session& session_;
  ObserverGains gains_;
  double damping_per_s_;
  std::vector<std::vector<bool>> rests_;
  std::vector<std::vector<double>> velocity_;
};

/// The best multiples of two columns that have been projected out of the basis.
Wave wave_of(const Eigen::Ref<const Eigen::MatrixXd>& pair, const Basis& basis) {
  const Eigen::Matrix2d h = pair.transpose() * pair;
  const Eigen::Vector2d g = pair.transpose() * basis.e;
  const Eigen::Vector2d x = h.ldlt().solve(g);
  const double left = std::max(basis.squares_m2 - x.dot(g), 1e-12 * basis.squares_m2);
  return {basis.gain(left), x[0], x[1]};
}

}  // namespace

std::size_t PositionSpectrum::first_told_apart() const {
  return static_cast<std::size_t>(2 * kStepsPerLobe) - 2;
}

PositionSpectrum position_spectrum(const Session& session, const Fit& base, const SessionFacts& facts,
                                   const FitOptions& options, Waves waves, unsigned threads) {
  const Basis basis = basis_of(base, options.outlier_m);
  const auto rows = basis.e.size();
  const bool with_reading = waves == Waves::of_push_and_reading;

  const double least_period =
      std::max(kLeastCounts * session.rig.encoder_resolution_m, 0.005 * facts.travel_m());
  PositionSpectrum spectrum;
  spectrum.step_per_m = 1 / (kStepsPerLobe * facts.travel_m());
  const std::size_t affordable =
      kMostFrequencies * std::max<std::size_t>(1, kRowsOfASession / static_cast<std::size_t>(rows));
  const auto count = std::min(affordable, static_cast<std::size_t>(1 / (least_period * spectrum.step_per_m)));
  const WaveColumns influence(session, base, options);
  const auto wavenumber = [&](double frequency_per_m) { return 2 * std::numbers::pi * frequency_per_m; };
  const SineAndCosine step(session, wavenumber(spectrum.step_per_m));

  spectrum.push.resize(count);
  if (with_reading) spectrum.reading.resize(count);
  parallel_for((count + kTurnedOn - 1) / kTurnedOn, threads, [&](std::size_t block) {
    const std::size_t begin = block * kTurnedOn, end = std::min(begin + kTurnedOn, count);
    SineAndCosine wave(session, wavenumber(spectrum.frequency_per_m(begin)));
    Eigen::MatrixXd columns(rows, with_reading ? 4 : 2);
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin) wave.turn(step);
      if (with_reading) {
        influence.fill<4>(wave, columns);
      } else {
        influence.fill<2>(wave, columns);
      }
      basis.project_out(columns);
      spectrum.push[i] = wave_of(columns.leftCols(2), basis);
      if (with_reading) spectrum.reading[i] = wave_of(columns.rightCols(2), basis);
    }
  });
  return spectrum;
}

}  // namespace cartwright
