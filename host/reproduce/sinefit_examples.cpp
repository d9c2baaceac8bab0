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
  std::vector<double> published_hz;  ///< where the published search ended
};

/// Draws of the signal at one frequency; the published search starts at each of `rough` times the truth.
Comparison run(double frequency_hz, double sigma, const std::vector<double>& rough,
               const ReproduceOptions& options) {
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
    for (const double factor : rough) {
      const auto printed = published_sinefit(t, y, factor * frequency_hz);
      result.published.add(printed.amplitude, printed.frequency_hz, printed.phase_rad, frequency_hz,
                           record_s);
      result.published_hz.push_back(printed.frequency_hz);
    }
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

void add_row(report::Table& table, double periods, double sigma, const char* search, const Spread& s,
             int draws) {
  const double frequency_hz = periods / (kStep_s * (kSamples - 1));
  const Eigen::Vector3d limit = bound(frequency_hz) * sigma * sigma;
  const double n = std::max(1, s.good);
  const Eigen::Vector3d bias = s.bias / n, ratio = s.square.cwiseQuotient(limit) / n;
  // Standard error of the mean, so that a reader sees which bias is one; two starts share a draw.
  const Eigen::Vector3d error = (s.square / n - bias.cwiseProduct(bias)).cwiseMax(0).cwiseSqrt() /
                                std::sqrt(std::min(n, static_cast<double>(draws)));
  const int all = s.good + s.on_side_lobe + s.refused;
  std::vector<report::Cell> row{fmt::format("{:g}", periods), fmt::format("{:g}", sigma), search};
  for (int k = 0; k < 3; ++k) row.push_back(fmt::format("{:+.1e} ± {:.0e}", bias(k), 2 * error(k)));
  for (int k = 0; k < 3; ++k) row.push_back(fmt::format("{:.2f}", ratio(k)));
  row.push_back(fmt::format("{:.1f} %", 100.0 * (s.on_side_lobe + s.refused) / std::max(1, all)));
  table.row(std::move(row));
}

/// The cost over the published search interval for one draw, and where all draws ended.
std::vector<report::Plot> side_lobe_plots(double periods, double sigma, const Comparison& c,
                                          const ReproduceOptions& options) {
  const double frequency_hz = periods / (kStep_s * (kSamples - 1));
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  std::vector<double> t, y;
  for (int i = 0; i < kSamples; ++i) {
    t.push_back(kStep_s * i);
    y.push_back(kAmplitude * std::sin(kTwoPi * frequency_hz * t.back() + kPhase_rad) +
                sigma * normal(random));
  }
  report::Plot cost;
  cost.title = fmt::format("{:g} periods: what is left over frequency, one draw", periods);
  cost.x = {"frequency", "Hz"};
  cost.y = {"rms of what is left", ""};
  report::Series curve{.name = "rms", .colour = report::Colour::model};
  for (int i = 0; i <= 2000; ++i) {
    curve.x.push_back(frequency_hz * (0.5 + 2.0 * i / 2000));
    curve.y.push_back(published_sinefit2(t, y, curve.x.back()).rms);
  }
  cost.add(std::move(curve));
  cost.guides = {{report::Guide::Along::x, frequency_hz, "truth"},
                 {report::Guide::Along::x, 0.75 * frequency_hz, "start"},
                 {report::Guide::Along::x, 1.25 * frequency_hz, "start"}};
  report::Plot ends;
  ends.title = fmt::format("{:g} periods: where the published search ends, both starts", periods);
  ends.x = {"frequency", "Hz"};
  ends.y = {"draws", ""};
  ends.add(report::histogram("published search", c.published_hz, 80));
  return {cost, ends};
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
  double done = 0;
  for (const auto& [sigma, rough] : {std::pair{1.0, 1.25}, std::pair{2.0, 0.75}}) {
    const Comparison c = run(kFrequency_hz, sigma, {rough}, options);
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
    options.progress(done += 0.1);
  }
  report::Table table;
  table.caption =
      "Bias, variance over the Cramer-Rao bound, and side lobes; the published search from 25 % above and "
      "below";
  table.columns = {
      {"periods"},         {"sigma"},         {"search"}, {"bias of A"}, {"of f", "Hz"},
      {"of phase", "rad"}, {"variance of A"}, {"of f"},   {"of phase"},  {"side lobe or refused"}};
  table.note = "Bias ± two standard errors. Bias and variance are of the draws that end on the main lobe.";
  for (const double periods : {2.0, 10.0, 50.0}) {
    for (const double sigma : {1.0, 2.0}) {
      const Comparison c = run(periods / (kStep_s * (kSamples - 1)), sigma, {1.25, 0.75}, options);
      add_row(table, periods, sigma, "published", c.published, options.draws);
      add_row(table, periods, sigma, "spectrum, Gauss-Newton", c.ours, options.draws);
      const auto lost = [](const Spread& s) {
        return 100.0 * (s.on_side_lobe + s.refused) / (s.good + s.on_side_lobe + s.refused);
      };
      section.items.push_back(
          {fmt::format("{:g} periods in the record, sigma = {:g}, start 25 % off: draws on a side lobe",
                       periods, sigma),
           "", fmt::format("{:.1f} % published search, {:.2f} % here", lost(c.published), lost(c.ours)),
           "the cost has lobes one record length apart; the search interval [0.5, 2] f holds many"});
      if (sigma < 2 && periods > 2) {
        for (auto& plot : side_lobe_plots(periods, sigma, c, options))
          section.plots.push_back(std::move(plot));
      }
      options.progress(done += 0.13);
    }
  }
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace cartwright::reproduce
