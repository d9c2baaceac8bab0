#include "host/reproduce/relay_examples.hpp"

#include <fmt/format.h>

#include <numbers>

#include "host/relay/relay_identify.hpp"
#include "host/reproduce/relay_plant.hpp"

namespace cartwright::reproduce {
namespace {

/// The papers' relays act in continuous time; this is close to it.
constexpr double kSampleRate_hz = 5000, kLength_s = 6;

RelayFeature feature(const RelayReport::Entry& e) {
  return {e.gains.h1_V, e.gains.h2_V, e.cycle->sine.amplitude.value,
          2 * std::numbers::pi * e.cycle->sine.frequency_hz.value};
}

/// Acceleration amplitude over h1, relative to the first test: one if the describing function were exact.
double consistency(const RelayFeature& first, const RelayFeature& other) {
  const auto ratio = [](const RelayFeature& f) {
    return f.amplitude_m * f.frequency_rad_per_s * f.frequency_rad_per_s / f.h1_V;
  };
  return ratio(other) / ratio(first);
}

std::string combinations(const RelayCombinations& c) {
  return fmt::format("Tp/Kp {:.4g} ({:+.1f} %), f1 {:.4g} ({:+.1f} %), 1/Kp + f2 {:.4g} ({:+.1f} %)",
                     c.tp_over_kp, 100 * (c.tp_over_kp * PaperPlant::kKp / PaperPlant::kTp_s - 1), c.f1_V,
                     100 * (c.f1_V / PaperPlant::kF1_V - 1), c.inverse_kp_plus_f2,
                     100 * (c.inverse_kp_plus_f2 / (1 / PaperPlant::kKp + PaperPlant::kF2) - 1));
}

std::string four(const RelayFourParameters& p) {
  return fmt::format("Kp {:.4g}, Tp {:.4g}, f1 {:.4g}, f2 {:.4g}", p.kp, p.tp_s, p.f1_V, p.f2);
}

RelayCombinations exact(const RelayReport& report) {
  RelayCombinations c;
  for (const auto& value : report.combinations) {
    if (value.name == "Tp/Kp") c.tp_over_kp = value.estimate.value;
    if (value.name == "f1") c.f1_V = value.estimate.value;
    if (value.name == "1/Kp+f2") c.inverse_kp_plus_f2 = value.estimate.value;
  }
  return c;
}

Result<RelayReport> experiments(const std::vector<std::pair<double, double>>& amplitudes_V) {
  return identify_from_relay(
      relay_session(PaperPlant::model(), amplitudes_V, rig_with(kSampleRate_hz, 0), kLength_s));
}

}  // namespace

Result<Section> relay_identification(const ReproduceOptions&) {
  Section section{fmt::format("Relay identification, Kp {:g}, Tp {:g} s, f1 {:g}, f2 {:g}", PaperPlant::kKp,
                              PaperPlant::kTp_s, PaperPlant::kF1_V, PaperPlant::kF2),
                  {}};
  const auto at_equality = experiments({{2, 1.5}, {2.5, 2}, {1, 0.5}});
  if (!at_equality) return tl::unexpected(at_equality.error());
  const auto& third = at_equality->recordings[2];
  if (!at_equality->recordings[0].cycle) return failure(at_equality->recordings[0].refused);
  section.items.push_back(
      {"memo 3.2, third test, h1 = 1, h2 = 0.5 = f1", "oscillates (Fig. 7)",
       third.cycle
           ? fmt::format(
                 "no more than {:.2g} m remain, {:.2g} of the first test", third.cycle->sine.amplitude.value,
                 third.cycle->sine.amplitude.value / at_equality->recordings[0].cycle->sine.amplitude.value)
           : third.refused,
       "the condition is h2 > f1; at equality only the relay's sampling keeps a tremor alive"});
  const auto three = experiments({{2, 1.5}, {2.5, 2}, {1, 0.7}});
  if (!three) return tl::unexpected(three.error());
  std::vector<RelayFeature> features;
  for (const auto& entry : three->recordings) {
    if (!entry.cycle) return failure(fmt::format("{}: {}", entry.file, entry.refused));
    features.push_back(feature(entry));
  }
  const auto printed = published_describing_function(features);
  if (!printed) return tl::unexpected(printed.error());
  const auto corrected = corrected_describing_function(features);
  if (!corrected) return tl::unexpected(corrected.error());
  section.items.push_back(
      {"memo 3.2, equations as printed, third test with h2 = 0.7",
       "Kp 9.1536, Tp 0.2446, f1 0.5402, f2 0.01879", four(*printed),
       "another third test; f2 apart from 1/Kp is an artefact of the missing w and takes up every "
       "error of the describing function"});
  section.items.push_back({"memo 3.2, c12", "1.0127",
                           fmt::format("{:.4f}", consistency(features[0], features[1])),
                           "one if the describing function were exact"});
  section.items.push_back({"memo 3.2, c13", "0.9268",
                           fmt::format("{:.4f}", consistency(features[0], features[2])),
                           "h2 = 0.7 in the third test"});
  section.items.push_back(
      {"the same three, corrected equations", "", combinations(*corrected), "the first harmonic alone"});
  section.items.push_back({"the same three, whole limit cycles matched", "", combinations(exact(*three)),
                           "exact: nothing is left out"});
  const auto two = experiments({{2, 1.5}, {1, 0.7}});
  if (!two) return tl::unexpected(two.error());
  const auto eq17 = published_equation_17(features[0], features[2]);
  if (!eq17) return tl::unexpected(eq17.error());
  section.items.push_back(
      {"paper Section 4, Eq. (17) as printed", "Kp 10, Tp 0.265, f1 0.5104, f2 0.0065", four(*eq17),
       "as printed it takes Kp and Tp from the first test as if there were no friction, which these "
       "relay amplitudes do not allow"});
  section.items.push_back({"paper Section 4, corrected equations", "",
                           two->corrected ? combinations(*two->corrected) : "none",
                           "the first harmonic alone"});
  section.items.push_back({"paper Section 4, whole limit cycles matched", "", combinations(exact(*two)),
                           "exact: nothing is left out"});
  return section;
}

}  // namespace cartwright::reproduce
