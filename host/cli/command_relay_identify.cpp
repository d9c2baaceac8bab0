#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/relay/relay_identify.hpp"

namespace cartwright::cli {
namespace {

using nlohmann::ordered_json;

ordered_json values_json(const std::vector<RelayReport::Value>& values) {
  ordered_json out = ordered_json::object();
  for (const auto& value : values) out[value.name] = estimate_json(value.estimate);
  return out;
}

ordered_json recording_json(const RelayReport::Entry& entry) {
  ordered_json out = {{"file", entry.file}, {"h1_V", entry.gains.h1_V}, {"h2_V", entry.gains.h2_V}};
  if (!entry.cycle) {
    out["refused"] = entry.refused;
    return out;
  }
  const SineFit& sine = entry.cycle->sine;
  out["refused"] = nullptr;
  out["settled_s"] = entry.cycle->settled_s;
  out["cycles"] = entry.cycle->cycles.size();
  out["amplitude_m"] = estimate_json(sine.amplitude);
  out["frequency_hz"] = estimate_json(sine.frequency_hz);
  out["offset_m"] = estimate_json(sine.offset);
  out["match_rmse_m"] = entry.rms_m;
  return out;
}

void print_json(const RelayReport& report) {
  ordered_json out = {{"parameters", values_json(report.parameters)},
                      {"not_separable", ordered_json::array()}};
  for (const Combination& c : report.not_separable) {
    ordered_json entry = {{"parameters", c.names}, {"combination", c.expression}};
    entry.update(estimate_json(c.estimate));
    entry["why"] = c.why;
    out["not_separable"].push_back(entry);
  }
  out["combinations"] = values_json(report.combinations);
  ordered_json functions = {{"corrected", nullptr}, {"published", nullptr}};
  if (report.corrected) {
    functions["corrected"] = {{"Tp/Kp", report.corrected->tp_over_kp},
                              {"f1", report.corrected->f1_V},
                              {"1/Kp+f2", report.corrected->inverse_kp_plus_f2}};
  }
  if (report.published) {
    functions["published"] = {{"Kp", number_json(report.published->kp)},
                              {"Tp", number_json(report.published->tp_s)},
                              {"f1", number_json(report.published->f1_V)},
                              {"f2", number_json(report.published->f2)}};
  }
  out["describing_function"] = functions;
  out["recordings"] = ordered_json::array();
  for (const auto& entry : report.recordings) out["recordings"].push_back(recording_json(entry));
  fmt::print("{}\n", out.dump(2));
}

void print_text(const RelayReport& report) {
  fmt::print("Limit cycles\n");
  for (const auto& e : report.recordings) {
    if (!e.cycle) {
      fmt::print("  {:<20} h1 {:.3g} V, h2 {:.3g} V: refused: {}\n", e.file, e.gains.h1_V, e.gains.h2_V,
                 e.refused);
      continue;
    }
    fmt::print(
        "  {:<20} h1 {:.3g} V, h2 {:.3g} V: amplitude {:.5g} m, {:.5g} Hz, offset {:.2g} m, settled at "
        "{:.2f} s, {} cycles, match leaves {:.2g} m rms\n",
        e.file, e.gains.h1_V, e.gains.h2_V, e.cycle->sine.amplitude.value, e.cycle->sine.frequency_hz.value,
        e.cycle->sine.offset.value, e.cycle->settled_s, e.cycle->cycles.size(), e.rms_m);
  }
  const auto line = [](const std::string& name, const Estimate& v) {
    fmt::print("  {:<42} {:>11.6g}   95 % within {:.6g} ... {:.6g}\n", name, v.value, v.low, v.high);
  };
  fmt::print("\nExact: the whole limit cycles matched in the time domain\n");
  for (const auto& value : report.parameters) line(value.name, value.estimate);
  for (const auto& value : report.combinations) line(value.name, value.estimate);
  for (const Combination& c : report.not_separable) {
    if (std::isfinite(c.estimate.value)) {
      line("only " + c.expression, c.estimate);
      fmt::print("    {}\n", c.why);
    }
  }
  fmt::print("\nDescribing function, for comparison (first harmonic alone: off by a few per cent)\n");
  if (report.corrected) {
    fmt::print("  corrected   Tp/Kp {:.6g}   f1 {:.6g} V   1/Kp+f2 {:.6g}\n", report.corrected->tp_over_kp,
               report.corrected->f1_V, report.corrected->inverse_kp_plus_f2);
  } else {
    fmt::print("  corrected   needs two recordings with different amplitudes\n");
  }
  if (report.published) {
    fmt::print(
        "  published   Kp {:.6g}   Tp {:.6g} s   f1 {:.6g} V   f2 {:.6g}   (f2 apart from 1/Kp is an "
        "artefact)\n",
        report.published->kp, report.published->tp_s, report.published->f1_V, report.published->f2);
  }
}

}  // namespace

void add_relay_identify(CLI::App& app, int& exit_status) {
  struct Options {
    std::string session;
    bool json = false;
  };
  CLI::App* command =
      app.add_subcommand("relay-identify", "Friction and dynamics from dual-relay recordings");
  command->footer(
      "Example:\n"
      "  cartwright relay-identify --session rig/monday\n"
      "All recordings whose controller is a dual relay are used together; one whose limit cycle\n"
      "dies out, sticks, drifts or has not converged is left out and the reason given.");
  auto options = std::make_shared<Options>();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_flag("--json", options->json, "one JSON object on standard output");
  on_run(command, exit_status, [options]() -> Outcome {
    const auto session = read_session(options->session);
    if (!session) return tl::unexpected(session.error());
    const auto report = identify_from_relay(*session);
    if (!report) return failure(fmt::format("{}: {}", options->session, report.error().message));
    options->json ? print_json(*report) : print_text(*report);
    return Status::done;
  });
}

}  // namespace cartwright::cli
