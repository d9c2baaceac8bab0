#include "host/diagnose/locate/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "host/diagnose/locate/position_spectrum.hpp"

namespace cartwright {
namespace {

constexpr double kOnceIn20 = 3.0;      // nats beyond the log of the points looked at
constexpr double kOnceIn20000 = 10.0;  // the same

void set_bars(Profile& profile) {
  const double looks = std::log(std::max<double>(1, static_cast<double>(profile.at.size())));
  profile.band = looks + kOnceIn20;
  profile.bar = looks + kOnceIn20000;
}

constexpr double kLowest_hz = 1, kHighest_hz = 150, kFrequencyStep_hz = 0.1;
/// To either side: some 30 independent powers of a recording of seven seconds.
constexpr double kColourOver_hz = 2.5;

/// Power of all recordings together at some frequencies, in units of what white errors have there on average
/// in one recording.
std::vector<double> periodogram(const Session& session, const std::vector<double>& error_m,
                                const std::vector<double>& at_hz) {
  constexpr std::size_t kAbreast = 4;  // recursions that need not wait for one another
  using Lanes = Eigen::Array<double, kAbreast, 1>;
  const std::size_t skip = settling_rows(session.rig);
  const Eigen::Map<const Eigen::VectorXd> all(error_m.data(), static_cast<Eigen::Index>(error_m.size()));
  const double variance = all.squaredNorm() / static_cast<double>(error_m.size());
  std::vector<double> powers;
  for (std::size_t i = 0; i < at_hz.size(); i += kAbreast) {
    const std::size_t lanes = std::min(kAbreast, at_hz.size() - i);
    Lanes frequency_hz = Lanes::Constant(at_hz[i]), power = Lanes::Zero();
    for (std::size_t lane = 0; lane < lanes; ++lane) frequency_hz[static_cast<int>(lane)] = at_hz[i + lane];
    const Lanes c = 2 * (2 * std::numbers::pi * frequency_hz / session.rig.sample_rate_hz).cos();
    std::size_t first = 0;
    for (const Recording& r : session.recordings) {
      if (r.size() <= skip) continue;
      const std::size_t rows = r.size() - skip;
      // Goertzel recursion; jitter of the ticks is far below a period of what is looked for.
      Lanes s1 = Lanes::Zero(), s2 = Lanes::Zero();
      for (std::size_t k = 0; k < rows; ++k) {
        const Lanes s = error_m[first + k] + c * s1 - s2;
        s2 = s1, s1 = s;
      }
      power += (s1 * s1 + s2 * s2 - c * s1 * s2) / (static_cast<double>(rows) * variance);
      first += rows;
    }
    powers.insert(powers.end(), power.begin(), power.begin() + static_cast<std::ptrdiff_t>(lanes));
  }
  return powers;
}

/// Means over a few hertz around each frequency.
std::vector<double> smoothed(const std::vector<double>& power) {
  const auto reach = static_cast<std::size_t>(std::lround(kColourOver_hz / kFrequencyStep_hz));
  std::vector<double> mean;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const std::size_t begin = i > reach ? i - reach : 0, end = std::min(i + reach + 1, power.size());
    mean.push_back(std::accumulate(power.begin() + static_cast<std::ptrdiff_t>(begin),
                                   power.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
                   static_cast<double>(end - begin));
  }
  return mean;
}

/// Gain of a line, from its power over R recordings: the Chernoff bound of the tail of R unit exponentials.
double gain_of_line(double power, double recordings) {
  return power > recordings ? power - recordings - recordings * std::log(power / recordings) : 0;
}

}  // namespace

std::size_t Profile::strongest() const {
  const auto size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::max_element(value.begin(), value.end(), size) - value.begin());
}

std::vector<std::size_t> Profile::lines(std::size_t most) const {
  constexpr std::size_t kFoot = 8;  // points: the first side lobes of a line over the way
  std::vector<std::size_t> order(value.size()), lines;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(value[a]) > std::abs(value[b]); });
  for (const std::size_t i : order) {
    if (lines.size() == most || std::abs(value[i]) <= bar) break;
    const bool foot = std::any_of(lines.begin(), lines.end(),
                                  [&](std::size_t j) { return (i > j ? i - j : j - i) < kFoot; });
    if (!foot) lines.push_back(i);
  }
  return lines;
}

bool Profile::flat() const {
  return value.empty() || std::abs(value[strongest()]) <= bar;
}

Profile spatial_frequency_profile(const Session& session, const Fit& fit, const FitOptions& options,
                                  unsigned threads) {
  const PositionSpectrum spectrum =
      position_spectrum(session, fit, facts_of(session), options, Waves::of_push, threads);
  Profile profile;
  profile.axis = "spatial_frequency_per_m";
  for (std::size_t i = spectrum.first_told_apart(); i < spectrum.push.size(); ++i) {
    profile.at.push_back(spectrum.frequency_per_m(i));
    profile.value.push_back(spectrum.push[i].gain);
  }
  set_bars(profile);
  if (profile.value.empty()) return profile;
  profile.share = 1 - std::exp(-2 * profile.value[profile.strongest()] / fit.rows);
  return profile;
}

Profile frequency_profile(const Session& session, const Fit& fit, const std::vector<double>& alike_m) {
  Profile profile;
  profile.axis = "frequency_hz";
  const double highest = std::min(kHighest_hz, 0.4 * session.rig.sample_rate_hz);
  for (double f = kLowest_hz; f < highest; f += kFrequencyStep_hz) profile.at.push_back(f);
  const std::vector<double> power = periodogram(session, fit.error_m, profile.at);
  const std::vector<double> power_of_alike = periodogram(session, alike_m, profile.at);
  const std::vector<double> colour = smoothed(power_of_alike);
  const auto recordings = static_cast<double>(
      std::count_if(session.recordings.begin(), session.recordings.end(),
                    [&](const Recording& r) { return r.size() > settling_rows(session.rig); }));
  double most_power = 0, most_of_alike = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    most_power = std::max(most_power, power[i]);
    const double white = std::max(1.0, colour[i] / recordings);
    profile.value.push_back(gain_of_line(power[i] / white, recordings));
    most_of_alike = std::max(most_of_alike, gain_of_line(power_of_alike[i] / white, recordings));
  }
  set_bars(profile);
  const double beyond = std::max(1.0, kStandsOutFromAlike * most_of_alike / profile.bar);
  profile.band *= beyond, profile.bar *= beyond;
  profile.share = std::min(1.0, 2 * most_power / fit.rows);
  return profile;
}

Profile input_lag_profile(const Session& session, const Fit& fit) {
  const std::size_t skip = settling_rows(session.rig);
  const auto lags = static_cast<std::size_t>(std::max(3.0, 0.03 * session.rig.sample_rate_hz));
  Profile profile;
  profile.axis = "input_lag_s";
  double least_rows = 1;  // that count: voltages change rarely in a relay test, and errors are not all alike
  for (std::size_t lag = 0; lag < lags; ++lag) {
    double dot = 0, uu = 0, ee = 0, products = 0;
    std::size_t first = 0;
    for (const Recording& r : session.recordings) {
      if (r.size() <= skip) continue;
      for (std::size_t k = std::max(skip, lag + 2); k < r.size(); ++k) {
        const double change = r.u_V[k - lag - 1] - r.u_V[k - lag - 2];
        const double e = fit.error_m[first + k - skip];
        dot += change * e, uu += change * change, ee += e * e;
        products += change * change * e * e;
      }
      first += r.size() - skip;
    }
    profile.at.push_back(static_cast<double>(lag) * session.rig.period_s());
    profile.value.push_back(uu > 0 && ee > 0 ? dot / std::sqrt(uu * ee) : 0);
    // Under chance the sum of products has this variance, whatever sizes changes and errors have.
    const double rows = products > 0 ? uu * ee / products : 1;
    least_rows = lag == 0 ? rows : std::min(least_rows, rows);
  }
  set_bars(profile);
  const auto correlation = [&](double nats) { return std::min(1.0, std::sqrt(2 * nats / least_rows)); };
  profile.band = correlation(profile.band);
  profile.bar = correlation(profile.bar);
  const double most = profile.value[profile.strongest()];
  profile.share = most * most;
  return profile;
}

}  // namespace cartwright
