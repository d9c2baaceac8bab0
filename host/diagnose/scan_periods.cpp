#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/basis.hpp"
#include "host/diagnose/influence.hpp"
#include "host/diagnose/scan.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kPeaksKept = 3;
constexpr double kStepsPerLobe = 2.5;  // lobes of the spectrum over position are 1/travel wide
/// The finest period looked for is this many encoder counts, and crossed in no less than so many ticks.
constexpr double kLeastCounts = 40;
constexpr std::size_t kMostFrequencies = 400;   // in a session of so many rows or more:
constexpr std::size_t kRowsOfASession = 70000;  // shorter ones can afford more

struct Peak {
  double gain = 0;
  double sine = 0, cosine = 0;
};

}  // namespace

std::vector<Promise> scan_periods(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads) {
  const Basis basis = basis_of(base, options.outlier_m);
  const Eigen::VectorXd& e = basis.e;
  const auto rows = e.size();
  const double ee = e.squaredNorm();

  const double least_period =
      std::max(kLeastCounts * session.rig.encoder_resolution_m, 0.005 * facts.travel_m());
  const double step = 1 / (kStepsPerLobe * facts.travel_m());
  const std::size_t affordable =
      kMostFrequencies * std::max<std::size_t>(1, kRowsOfASession / static_cast<std::size_t>(rows));
  const auto count = std::min(affordable, static_cast<std::size_t>(1 / (least_period * step)));
  const ObserverGains gains = observer_gains(base.noise, session.rig, options.damping_per_s);
  const std::size_t skip = settling_rows(session.rig), starting = skip / 2;
  std::vector<std::vector<double>> velocity;
  ObserverOptions keep;
  keep.keep_states = true;
  for (const Recording& r : session.recordings) {
    velocity.push_back(observe(base.model, gains, session.rig, r, keep).velocity_m_per_s);
  }

  std::vector<Peak> push(count), reading(count);
  parallel_for(count, threads, [&](std::size_t i) {
    const double wavenumber = 2 * std::numbers::pi * step * static_cast<double>(i + 2);
    Eigen::MatrixXd columns(rows, 4);
    Eigen::Index row = 0;
    for (std::size_t n = 0; n < session.recordings.size(); ++n) {
      const Recording& r = session.recordings[n];
      Influence ps(gains, session.rig.period_s(), options.damping_per_s), pc = ps, rs = ps, rc = ps;
      double s = std::sin(wavenumber * r.y_m[0]), c = std::cos(wavenumber * r.y_m[0]);
      for (std::size_t k = 1; k < r.size(); ++k) {
        const bool stuck = velocity[n][k] == 0;
        const bool start = k < starting;
        const double e0 = ps.step(start, stuck ? 0 : s, 0), e1 = pc.step(start, stuck ? 0 : c, 0);
        s = std::sin(wavenumber * r.y_m[k]);
        c = std::cos(wavenumber * r.y_m[k]);
        const double e2 = rs.step(start, 0, s), e3 = rc.step(start, 0, c);
        if (k < skip) continue;
        columns.row(row++) << e0, e1, e2, e3;
      }
    }
    basis.project_out(columns);
    const auto gain_of = [&](Eigen::Index first) {
      const auto pair = columns.middleCols(first, 2);
      const Eigen::Matrix2d h = pair.transpose() * pair;
      const Eigen::Vector2d g = pair.transpose() * e;
      const Eigen::Vector2d x = h.ldlt().solve(g);
      const double left = std::max(ee - x.dot(g), 1e-12 * ee);
      return Peak{0.5 * static_cast<double>(rows) * std::log(ee / left), x[0], x[1]};
    };
    push[i] = gain_of(0);
    reading[i] = gain_of(2);
  });

  std::vector<Promise> promises;
  // A period of the travel's own length bends like a straight line: it is not told from scale and offset.
  const auto first = static_cast<std::size_t>(2 * kStepsPerLobe) - 2;
  const auto take_peaks = [&](const std::vector<Peak>& peaks, Term term, Parameter amplitude,
                              Parameter period, Parameter phase) {
    std::vector<std::size_t> tops;
    for (std::size_t i = first; i < count; ++i) {
      if (i > first && peaks[i - 1].gain > peaks[i].gain) continue;
      if (i + 1 < count && peaks[i + 1].gain >= peaks[i].gain) continue;
      tops.push_back(i);
    }
    std::sort(tops.begin(), tops.end(), [&](auto a, auto b) { return peaks[a].gain > peaks[b].gain; });
    if (tops.size() > kPeaksKept) tops.resize(kPeaksKept);
    for (const std::size_t i : tops) {
      Model start = base.model;
      start.set(amplitude, std::hypot(peaks[i].sine, peaks[i].cosine));
      start.set(period, 1 / (step * static_cast<double>(i + 2)));
      start.set(phase, std::atan2(peaks[i].cosine, peaks[i].sine));
      Promise promise{term, start, base.free, peaks[i].gain - std::log(static_cast<double>(count))};
      for (const Parameter id : {amplitude, period, phase})
        promise.free.push_back(free_parameter(id, facts, start));
      promises.push_back(std::move(promise));
    }
  };
  if (!base.model.has(Term::cogging)) {
    take_peaks(push, Term::cogging, Parameter::cogging_amplitude, Parameter::cogging_period,
               Parameter::cogging_phase);
  }
  if (!base.model.has(Term::encoder_eccentricity)) {
    take_peaks(reading, Term::encoder_eccentricity, Parameter::eccentricity_amplitude,
               Parameter::eccentricity_period, Parameter::eccentricity_phase);
  }
  return promises;
}

}  // namespace cartwright
