#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/fit/influence.hpp"
#include "host/diagnose/search/scan.hpp"

namespace cartwright {
namespace {

constexpr double kDurations_s[] = {0.03, 0.06, 0.12, 0.25, 0.5, 1.0};
constexpr std::size_t kPushesKept = 3;
constexpr double kLeastJumpCounts = 2;
constexpr double kLeastJumpGain = 25;  // nats: one in 1e10 looks at white noise
constexpr double kVelocitySpan_s = 0.01;
constexpr double kJumpTail_s = 0.05;  // length of the template behind a jump

/// What the observer shows of an input until that has died away.
template <typename Input>
std::vector<double> response(const ObserverGains& gains, const Rig& rig, double damping, Input input,
                             std::size_t input_rows) {
  Influence influence(gains, rig.period_s(), damping);
  std::vector<double> out;
  double peak = 0;
  for (std::size_t k = 0; k < input_rows + 2000; ++k) {
    const auto [acceleration, reading] = input(k);
    out.push_back(influence.step(ObserverGains::kSettledRow, acceleration, reading));
    peak = std::max(peak, std::abs(out.back()));
    if (k > input_rows + 20) {
      const bool quiet =
          std::all_of(out.end() - 20, out.end(), [&](double e) { return std::abs(e) < 0.03 * peak; });
      if (quiet) break;
    }
  }
  return out;
}

bool within_push(const Model& model, const Recording& recording, std::size_t row) {
  if (!model.has(Term::external_disturbance) || model.disturbance_recording != recording.file) return false;
  const double since_s = recording.t_s[row] - model[Parameter::disturbance_start];
  return since_s >= 0 && since_s <= model[Parameter::disturbance_duration];
}

}  // namespace

std::vector<Promise> scan_pushes(const Session& session, const Fit& base, const SessionFacts& facts,
                                 const FitOptions& options) {
  const Rig& rig = session.rig;
  const ObserverGains gains = observer_gains(base.noise, rig.period_s(), options.damping_per_s);
  const double variance = base.error_rms_m * base.error_rms_m;
  const std::size_t skip = settling_rows(rig);
  struct Found {
    double gain, start_s, duration_s, peak;
    std::size_t recording;
  };
  std::vector<Found> found;
  double looks = 1;
  for (const double duration : kDurations_s) {
    const auto length = static_cast<std::size_t>(duration * rig.sample_rate_hz);
    if (length < 4) continue;
    const std::vector<double> shape = response(
        gains, rig, options.damping_per_s,
        [&](std::size_t k) {
          const double x = (static_cast<double>(k) + 0.5) / static_cast<double>(length);
          const double sine = x < 1 ? std::sin(std::numbers::pi * x) : 0.0;
          return std::pair{sine * sine, 0.0};
        },
        length);
    double energy = 0;
    for (const double s : shape) energy += s * s;
    const std::size_t hop = std::max<std::size_t>(1, length / 6);
    std::size_t first = 0;
    for (std::size_t n = 0; n < session.recordings.size(); ++n) {
      const Recording& r = session.recordings[n];
      const std::size_t rows = r.size() > skip ? r.size() - skip : 0;
      for (std::size_t at = 0; at + length < rows; at += hop) {
        double dot = 0;
        const std::size_t most = std::min(shape.size(), rows - at);
        for (std::size_t k = 0; k < most; ++k) {
          double e = base.error_m[first + at + k];
          if (options.outlier_m > 0) e = std::clamp(e, -options.outlier_m, options.outlier_m);
          dot += shape[k] * e;
        }
        ++looks;
        const double start = r.t_s[skip + at - 1];
        found.push_back({0.5 * dot * dot / (energy * variance), start, duration, dot / energy, n});
      }
      first += rows;
    }
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.gain > b.gain; });
  std::vector<Promise> promises;
  for (const Found& f : found) {
    if (promises.size() >= kPushesKept) break;
    Model start = base.model;
    start.set(Parameter::disturbance_start, f.start_s)
        .set(Parameter::disturbance_duration, f.duration_s)
        .set(Parameter::disturbance_peak, f.peak);
    start.disturbance_recording = session.recordings[f.recording].file;
    const bool seen = std::any_of(promises.begin(), promises.end(), [&](const Promise& p) {
      return p.start.disturbance_recording == start.disturbance_recording &&
             std::abs(p.start[Parameter::disturbance_start] - f.start_s) < 0.5 * f.duration_s &&
             p.start[Parameter::disturbance_duration] == f.duration_s;
    });
    if (seen) continue;
    Promise promise{Term::external_disturbance, start, base.free, f.gain - std::log(looks)};
    for (const Parameter id :
         {Parameter::disturbance_start, Parameter::disturbance_duration, Parameter::disturbance_peak}) {
      promise.free.push_back(free_parameter(id, facts, start));
    }
    promises.push_back(std::move(promise));
  }
  return promises;
}

std::vector<ReadingJump> scan_jumps(const Session& session, const Fit& base, const FitOptions& options) {
  const Rig& rig = session.rig;
  const double count = rig.encoder_resolution_m;
  if (!(count > 0)) return {};
  const ObserverGains gains = observer_gains(base.noise, rig.period_s(), options.damping_per_s);
  std::vector<double> shape = response(
      gains, rig, options.damping_per_s,
      [](std::size_t) {
        return std::pair{0.0, 1.0};
      },
      1);
  shape.resize(std::min(shape.size(), static_cast<std::size_t>(kJumpTail_s * rig.sample_rate_hz) + 2));
  double energy = 0;
  for (const double s : shape) energy += s * s;
  // A median-based noise size: the jumps themselves must not set the bar for finding them.
  const double noise = robust_size(base);
  const double variance = noise * noise;

  std::vector<ReadingJump> jumps;
  const std::size_t skip = settling_rows(rig);
  std::size_t first = 0;
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    const std::size_t rows = session.recordings[n].size() > skip ? session.recordings[n].size() - skip : 0;
    std::vector<double> e(base.error_m.begin() + static_cast<std::ptrdiff_t>(first),
                          base.error_m.begin() + static_cast<std::ptrdiff_t>(first + rows));
    first += rows;
    // Strongest first; each found jump is taken out of the errors before the next is looked for.
    for (int found = 0; found < 200; ++found) {
      double best = kLeastJumpGain, step = 0;
      std::size_t where = rows;
      for (std::size_t at = 0; at + 2 < rows; ++at) {
        if (std::abs(e[at]) < 0.5 * kLeastJumpCounts * count) continue;
        double dot = 0;
        const std::size_t most = std::min(shape.size(), rows - at);
        for (std::size_t k = 0; k < most; ++k) dot += shape[k] * e[at + k];
        const double gain = 0.5 * dot * dot / (energy * variance);
        if (gain > best && std::abs(dot / energy) >= kLeastJumpCounts * count) {
          best = gain, step = dot / energy, where = at;
        }
      }
      if (where == rows) break;
      for (std::size_t k = 0; k < shape.size() && where + k < rows; ++k) e[where + k] -= step * shape[k];
      if (within_push(base.model, session.recordings[n], where + skip)) continue;
      jumps.push_back({n, where + skip, count * std::round(step / count)});
    }
  }
  return jumps;
}

double velocity_at(const Recording& r, std::size_t row) {
  const double period_s = (r.t_s.back() - r.t_s.front()) / static_cast<double>(r.size() - 1);
  const auto half = static_cast<std::size_t>(std::max(1.0, kVelocitySpan_s / (2 * period_s)));
  const std::size_t a = row > half ? row - half : 0, b = std::min(row + half, r.size() - 1);
  return b > a ? (r.y_m[b] - r.y_m[a]) / (r.t_s[b] - r.t_s[a]) : 0;
}

Session without_jumps(Session session, const std::vector<ReadingJump>& jumps) {
  for (const ReadingJump& jump : jumps) {
    std::vector<double>& y = session.recordings[jump.recording].y_m;
    for (std::size_t k = jump.row; k < y.size(); ++k) y[k] -= jump.step_m;
  }
  return session;
}

}  // namespace cartwright
