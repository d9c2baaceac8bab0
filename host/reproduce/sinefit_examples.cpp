#include "host/reproduce/sinefit_examples.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "host/relay/sinefit.hpp"
#include "host/reproduce/published_sinefit.hpp"
#include "host/reproduce/relay_plant.hpp"

namespace cartwright::reproduce {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
/// The signal of Section 3.3.
constexpr double kAmplitude = 2, kFrequency_hz = 2, kPhase_rad = std::numbers::pi / 2, kStep_s = 0.005;
constexpr int kSamples = 401;

struct Spread {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero(), square = Eigen::Vector3d::Zero();  ///< A, f, phase
  int good = 0, on_side_lobe = 0, refused = 0;

  void add(double amplitude, double frequency_hz, double phase_rad, double truth_hz, double record_s) {
    if (std::abs(frequency_hz - truth_hz) * record_s > 1) {
      ++on_side_lobe;
      return;
    }
    const Eigen::Vector3d error(amplitude - kAmplitude, frequency_hz - truth_hz,
                                std::remainder(phase_rad - kPhase_rad, kTwoPi));
    bias += error;
    square += error.cwiseProduct(error);
    ++good;
  }
};

/// Cramer-Rao bound (variances of A, f, phase; offset unknown too) for noise of variance 1.
Eigen::Vector3d bound(double frequency_hz) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const double t = kStep_s * i, angle = kTwoPi * frequency_hz * t + kPhase_rad;
    const Eigen::Vector4d row(std::sin(angle), kAmplitude * std::cos(angle) * kTwoPi * t,
                              kAmplitude * std::cos(angle), 1);
    information += row * row.transpose();
  }
  return information.inverse().diagonal().head<3>();
}

struct Comparison {
  Spread published, ours;
};

Comparison run(double frequency_hz, double sigma, double rough, const ReproduceOptions& options) {
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  const double record_s = kStep_s * (kSamples - 1);
  Comparison result;
  std::vector<double> t(kSamples), y(kSamples);
  for (int draw = 0; draw < options.draws; ++draw) {
    for (int i = 0; i < kSamples; ++i) {
      const auto k = static_cast<std::size_t>(i);
      t[k] = kStep_s * i;
      y[k] = kAmplitude * std::sin(kTwoPi * frequency_hz * t[k] + kPhase_rad) + sigma * normal(random);
    }
    const auto printed = published_sinefit(t, y, rough * frequency_hz);
    result.published.add(printed.amplitude, printed.frequency_hz, printed.phase_rad, frequency_hz, record_s);
    const auto fit = sinefit(t, y);
    if (fit) {
      result.ours.add(fit->amplitude.value, fit->frequency_hz.value, fit->phase_rad.value, frequency_hz,
                      record_s);
    } else {
      ++result.ours.refused;
    }
  }
  return result;
}

std::string spread_text(const Spread& s, double sigma, double frequency_hz) {
  const Eigen::Vector3d limit = bound(frequency_hz) * sigma * sigma;
  const Eigen::Vector3d ratio = s.square.cwiseQuotient(limit) / std::max(1, s.good);
  const Eigen::Vector3d bias = s.bias / std::max(1, s.good);
  return fmt::format(
      "bias A {:+.4f}, f {:+.5f} Hz, phase {:+.4f} rad; variance over bound {:.2f}, {:.2f}, {:.2f}", bias(0),
      bias(1), bias(2), ratio(0), ratio(1), ratio(2));
}

}  // namespace

Result<Section> relay_record_example(const ReproduceOptions&) {
  // The third test of the relay paper oscillates at about 10 cycles in 3 s, as the record of Fig. 1 does.
  const Session session = relay_session(PaperPlant::model(), {{1, 0.7}}, rig_with(1000, 0), 10);
  const Recording& r = session.recordings.front();
  const auto last = [](const std::vector<double>& v) { return std::span(v).last(3000); };
  const auto fit = sinefit(last(r.t_s), last(r.y_m));
  if (!fit) return tl::unexpected(fit.error());
  const auto fixed = sinefit(last(r.t_s), last(r.y_m), {.frequency_hz = 10.0 / 3.0, .harmonics = 1});
  if (!fixed) return tl::unexpected(fixed.error());
  Section section{"sinefit memo, Section 3.1: a relay record, 3000 points, 1 ms", {}};
  section.items.push_back({"rms at the rough frequency 10/3 Hz over rms at the best one",
                           "about 2 (1038 against Fig. 2)",
                           fmt::format("{:.2f} (best frequency {:.4f} Hz, {:.2f} cycles)",
                                       fixed->rms / fit->rms, fit->frequency_hz.value, fit->periods),
                           "the measured record is not public: another plant, the same effect"});
  return section;
}

Result<Section> noise_examples(const ReproduceOptions& options) {
  Section section{fmt::format("sinefit memo, Section 3.3: noise, {} draws", options.draws), {}};
  for (const auto& [sigma, rough] : {std::pair{1.0, 1.25}, std::pair{2.0, 0.75}}) {
    const Comparison c = run(kFrequency_hz, sigma, rough, options);
    const std::string name = fmt::format("sigma = {:g}, start {:g} Hz", sigma, rough * kFrequency_hz);
    section.items.push_back(
        {name + ", the published search", sigma < 2 ? "Fig. 10: fits" : "Fig. 11: fits",
         spread_text(c.published, sigma, kFrequency_hz) +
             fmt::format("; {} on a side lobe", c.published.on_side_lobe),
         "no offset is fitted, so the bound with an unknown offset is not quite its own"});
    section.items.push_back(
        {name + ", spectrum and Gauss-Newton", "",
         spread_text(c.ours, sigma, kFrequency_hz) +
             fmt::format("; {} on a side lobe, {} refused", c.ours.on_side_lobe, c.ours.refused),
         "needs no start"});
  }
  const double record_s = kStep_s * (kSamples - 1);
  for (const double periods : {2.0, 10.0, 50.0}) {
    int published = 0, ours = 0;
    for (const double rough : {1.25, 0.75}) {
      const Comparison c = run(periods / record_s, 1, rough, options);
      published += c.published.on_side_lobe;
      ours += c.ours.on_side_lobe + c.ours.refused;
    }
    section.items.push_back(
        {fmt::format("{:g} periods in the record, start 25 % off: draws on a side lobe", periods), "",
         fmt::format("{:.1f} % published search, {:.2f} % here", 50.0 * published / options.draws,
                     50.0 * ours / options.draws),
         "the cost has lobes one record length apart; the search interval [0.5, 2] f holds many"});
  }
  return section;
}

}  // namespace cartwright::reproduce
