#include "tests/blind/saved.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

namespace cartwright::blind {
namespace {

using nlohmann::json;

/// JSON has no word for what is not a number or infinite: null, read back as `absent`.
double number(const json& value, double absent) {
  return value.is_null() ? absent : value.get<double>();
}

json evidence_json(const Evidence& e) {
  return {{"gain_nats", e.gain_nats}, {"share_of_gain", e.share_of_gain}, {"margin_nats", e.margin_nats},
          {"rivals", e.rivals},       {"share_left", e.share_left},       {"equivalent", e.equivalent},
          {"at_bound", e.at_bound}};
}

Evidence evidence_from(const json& j) {
  Evidence e;
  e.gain_nats = j.at("gain_nats");
  e.share_of_gain = j.at("share_of_gain");
  e.margin_nats = number(j.at("margin_nats"), std::numeric_limits<double>::infinity());
  e.rivals = j.at("rivals");
  e.share_left = j.at("share_left");
  e.equivalent = j.at("equivalent");
  e.at_bound = j.at("at_bound");
  return e;
}

Verdict verdict_from(const std::string& text) {
  for (const Verdict v :
       {Verdict::no_mismatch, Verdict::parameters_only, Verdict::missing_physics, Verdict::unexplained}) {
    if (cartwright::name(v) == text) return v;
  }
  throw std::out_of_range("no verdict is called " + text);
}

}  // namespace

std::string to_line(const Outcome& o) {
  json named = json::array(), parameters = json::array();
  for (const NamedEffect& n : o.named) {
    named.push_back({{"name", n.name},
                     {"confidence", n.confidence},
                     {"right", n.right},
                     {"evidence", evidence_json(n.evidence)}});
  }
  for (const ParameterOutcome& p : o.parameters)
    parameters.push_back({{"name", p.name}, {"relative_error", p.relative_error}, {"covered", p.covered}});
  const json line{{"effects", o.asked.effects},
                  {"size", static_cast<int>(o.asked.size)},
                  {"seed", o.asked.seed},
                  {"recordings", o.asked.recordings},
                  {"sample_rate_hz", o.asked.instruments.sample_rate_hz},
                  {"count_m", o.asked.instruments.count_m},
                  {"expected", o.expected},
                  {"verdict", cartwright::name(o.verdict)},
                  {"named", named},
                  {"parameters", parameters},
                  {"gain_error", o.gain_error},
                  {"gain_covered", o.gain_covered},
                  {"unseen_excess_removed", o.unseen_excess_removed},
                  {"window_error_m", o.window_error_m},
                  {"noise_floor_m", o.noise_floor_m},
                  {"time_s", o.time_s},
                  {"baselines", o.baselines},
                  {"baselines_time_s", o.baselines_time_s}};
  return line.dump();
}

Result<Outcome> from_line(const std::string& text) {
  try {
    const json line = json::parse(text);
    Outcome o;
    o.asked = {line.at("effects"),
               static_cast<Size>(line.at("size").get<int>()),
               line.at("seed"),
               line.value("recordings", std::size_t{10}),
               {line.value("sample_rate_hz", Instruments{}.sample_rate_hz),
                line.value("count_m", Instruments{}.count_m)}};
    o.expected = line.at("expected").get<std::vector<std::string>>();
    o.verdict = verdict_from(line.at("verdict"));
    for (const json& n : line.at("named"))
      o.named.push_back({n.at("name"), n.at("confidence"), n.at("right"), evidence_from(n.at("evidence"))});
    for (const json& p : line.at("parameters"))
      o.parameters.push_back({p.at("name"), number(p.at("relative_error"), std::nan("")), p.at("covered")});
    o.gain_error = line.at("gain_error");
    o.gain_covered = line.at("gain_covered");
    o.unseen_excess_removed = number(line.at("unseen_excess_removed"), std::nan(""));
    o.window_error_m = line.at("window_error_m");
    o.noise_floor_m = line.at("noise_floor_m");
    o.time_s = line.at("time_s");
    o.baselines = line.at("baselines").get<std::map<std::string, std::vector<std::string>>>();
    o.baselines_time_s = line.at("baselines_time_s");
    return o;
  } catch (const std::exception& e) {
    return failure(fmt::format("not an outcome of blind_proof: {}", e.what()));
  }
}

Result<std::vector<Outcome>> read_outcomes(const std::filesystem::path& file) {
  std::vector<Outcome> outcomes;
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (in.eof()) break;  // no line end: never finished
    if (line.empty()) continue;
    auto outcome = from_line(line);
    if (!outcome)
      return failure(fmt::format("{}, line {}: {}", file.string(), number, outcome.error().message));
    std::erase_if(outcomes, [&](const Outcome& o) { return o.asked == outcome->asked; });
    outcomes.push_back(std::move(*outcome));
  }
  return outcomes;
}

void drop_unfinished_line(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t end = text.rfind('\n');
  const std::size_t whole = end == std::string::npos ? 0 : end + 1;
  if (whole < text.size()) std::filesystem::resize_file(file, whole);
}

Result<void> append_outcome(const Outcome& outcome, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::app);
  out << to_line(outcome) << '\n' << std::flush;
  if (!out) return failure(fmt::format("{}: cannot be written to", file.string()));
  return {};
}

}  // namespace cartwright::blind
