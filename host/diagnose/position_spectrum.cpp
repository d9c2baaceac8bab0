#include "host/diagnose/position_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/influence.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

constexpr double kStepsPerLobe = 2.5;  // lobes of the spectrum over position are 1/travel wide
/// The finest period looked for is this many encoder counts, and crossed in no less than so many ticks.
constexpr double kLeastCounts = 40;
constexpr std::size_t kMostFrequencies = 400;   // in a session of so many rows or more:
constexpr std::size_t kRowsOfASession = 70000;  // shorter ones can afford more

/// The best multiples of two columns that have been projected out of the basis.
Wave wave_of(const Eigen::Ref<const Eigen::MatrixXd>& pair, const Eigen::VectorXd& e, double ee) {
  const Eigen::Matrix2d h = pair.transpose() * pair;
  const Eigen::Vector2d g = pair.transpose() * e;
  const Eigen::Vector2d x = h.ldlt().solve(g);
  const double left = std::max(ee - x.dot(g), 1e-12 * ee);
  return {0.5 * static_cast<double>(e.size()) * std::log(ee / left), x[0], x[1]};
}

}  // namespace

std::size_t PositionSpectrum::first_told_apart() const {
  return static_cast<std::size_t>(2 * kStepsPerLobe) - 2;
}

PositionSpectrum position_spectrum(const Session& session, const Fit& base, const SessionFacts& facts,
                                   const FitOptions& options, Waves waves, unsigned threads) {
  const Basis basis = basis_of(base, options.outlier_m);
  const auto rows = basis.e.size();
  const double ee = basis.e.squaredNorm();
  const bool with_reading = waves == Waves::of_push_and_reading;

  const double least_period =
      std::max(kLeastCounts * session.rig.encoder_resolution_m, 0.005 * facts.travel_m());
  PositionSpectrum spectrum;
  spectrum.step_per_m = 1 / (kStepsPerLobe * facts.travel_m());
  const std::size_t affordable =
      kMostFrequencies * std::max<std::size_t>(1, kRowsOfASession / static_cast<std::size_t>(rows));
  const auto count = std::min(affordable, static_cast<std::size_t>(1 / (least_period * spectrum.step_per_m)));
  const ObserverGains gains = observer_gains(base.noise, session.rig, options.damping_per_s);
  const std::size_t skip = settling_rows(session.rig), starting = skip / 2;
  std::vector<std::vector<double>> velocity;
  ObserverOptions keep;
  keep.keep_states = true;
  for (const Recording& r : session.recordings) {
    velocity.push_back(observe(base.model, gains, session.rig, r, keep).velocity_m_per_s);
  }

  spectrum.push.resize(count);
  if (with_reading) spectrum.reading.resize(count);
  parallel_for(count, threads, [&](std::size_t i) {
    const double wavenumber = 2 * std::numbers::pi * spectrum.frequency_per_m(i);
    Eigen::MatrixXd columns(rows, with_reading ? 4 : 2);
    Eigen::Index row = 0;
    for (std::size_t n = 0; n < session.recordings.size(); ++n) {
      const Recording& r = session.recordings[n];
      Influence ps(gains, session.rig.period_s(), options.damping_per_s), pc = ps, rs = ps, rc = ps;
      double s = std::sin(wavenumber * r.y_m[0]), c = std::cos(wavenumber * r.y_m[0]);
      for (std::size_t k = 1; k < r.size(); ++k) {
        const bool stuck = velocity[n][k] == 0;
        const bool start = k < starting;
        const double of_sine = ps.step(start, stuck ? 0 : s, 0), of_cosine = pc.step(start, stuck ? 0 : c, 0);
        s = std::sin(wavenumber * r.y_m[k]);
        c = std::cos(wavenumber * r.y_m[k]);
        const bool counts = k >= skip;
        if (counts) columns(row, 0) = of_sine, columns(row, 1) = of_cosine;
        if (with_reading) {
          const double read_sine = rs.step(start, 0, s), read_cosine = rc.step(start, 0, c);
          if (counts) columns(row, 2) = read_sine, columns(row, 3) = read_cosine;
        }
        row += counts;
      }
    }
    basis.project_out(columns);
    spectrum.push[i] = wave_of(columns.leftCols(2), basis.e, ee);
    if (with_reading) spectrum.reading[i] = wave_of(columns.rightCols(2), basis.e, ee);
  });
  return spectrum;
}

}  // namespace cartwright
