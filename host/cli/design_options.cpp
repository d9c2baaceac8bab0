#include "host/cli/design_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <thread>

#include "common/config/controller_toml.hpp"
#include "common/wire/register_map.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

using design::GainRange;
using design::Quantity;

/// A number within [least, most]; CLI11 takes "nan" and "inf" for numbers too.
CLI::Validator within(double least, double most, const char* description) {
  return {[least, most](std::string& text) {
            double value = 0;
            const bool fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                              value >= least && value <= most;
            return fine ? std::string()
                        : fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
          },
          description};
}

Result<double> number(std::string_view text, std::string_view option) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return failure(fmt::format("{}: \"{}\" is not a number; give one, or a range LEAST:MOST", option, text));
  }
  return value;
}

/// "100" or "20:200", within what the controller takes.
Result<GainRange> range(const std::string& text, std::string_view option, double most) {
  const auto colon = text.find(':');
  const auto low = number(std::string_view(text).substr(0, colon), option);
  if (!low) return tl::unexpected(low.error());
  const auto high =
      colon == std::string::npos ? low : number(std::string_view(text).substr(colon + 1), option);
  if (!high) return tl::unexpected(high.error());
  if (*low < 0 || *high < *low || *high > most) {
    return failure(fmt::format("{}: {} must rise within 0 to {:g}", option, text, most));
  }
  return GainRange{*low, *high};
}

/// [rig] of a rig file or of a session.
Result<Rig> read_rig(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto document = parse_toml(*text, file.string());
  if (!document) return tl::unexpected(document.error());
  return rig_from_toml(TomlReader(*document, file.string()));
}

Result<void> check_ideal(const DesignOptions& options, const CLI::App& command) {
  if (!options.ideal) return {};
  for (const char* other : {"--rig", "--session", "--rate", "--voltage-limit", "--encoder", "--filter",
                            "--derivative-on", "--out", "--relay"}) {
    if (command.count(other) > 0) {
      return failure(fmt::format(
          "--ideal is the continuous law without limit, filter and encoder: leave out {}", other));
    }
  }
  return {};
}

Result<Rig> rig_of(const DesignOptions& options) {
  Rig rig;
  if (!options.rig.empty() || !options.session.empty()) {
    const auto read = read_rig(options.rig.empty() ? std::filesystem::path(options.session) / "session.toml"
                                                   : std::filesystem::path(options.rig));
    if (!read) return read;
    rig = *read;
    const auto inside = [&](double position_m) {
      return position_m >= rig.travel_m[0] && position_m <= rig.travel_m[1];
    };
    if (!inside(options.start_m) || !inside(options.start_m + options.step_m)) {
      return failure(fmt::format(
          "a step from {:g} to {:g} m leaves the rig's travel of {:g} to {:g} m: see --start and --step",
          options.start_m, options.start_m + options.step_m, rig.travel_m[0], rig.travel_m[1]));
    }
  }
  rig.sample_rate_hz = options.rate_hz.value_or(rig.sample_rate_hz);
  rig.voltage_limit_V = options.voltage_limit_V.value_or(rig.voltage_limit_V);
  rig.encoder_resolution_m = options.encoder_m.value_or(rig.encoder_resolution_m);
  return rig;
}

design::Specification specification_of(const DesignOptions& options) {
  design::Specification s;
  s.settling_band = options.settling_band;
  s.limits = options.limits;
  return s;
}

design::StepTest step_of(const DesignOptions& options) {
  design::StepTest step;
  step.step_m = options.step_m;
  step.start_m = options.start_m;
  // Long enough to see a response that settles far too late, and to come to rest.
  double longest_s = 0;
  for (const Quantity q : {Quantity::settling_time, Quantity::rise_time}) {
    longest_s = std::max(longest_s, options.limits[static_cast<std::size_t>(q)].value_or(0));
  }
  step.duration_s = options.duration_s.value_or(longest_s > 0 ? std::clamp(3 * longest_s, 0.2, 40.0) : 2.0);
  return step;
}

}  // namespace

void add_design_options(CLI::App& command, DesignOptions& o) {
  command.add_option("--model", o.model, "model file (TOML), with [intervals] if it has them")->required();
  const auto limit = [&](const char* name, Quantity q, CLI::Validator valid, const char* text) {
    command.add_option(name, o.limits[static_cast<std::size_t>(q)], text)->check(valid);
  };
  limit("--settling-time", Quantity::settling_time, within(1e-3, 100, ""),
        "settled no later than this after the step [s]");
  command
      .add_option("--settling-band", o.settling_band, "and from then on this close, as a part of the step")
      ->capture_default_str()
      ->check(within(1e-4, 0.5, ""));
  limit("--overshoot", Quantity::overshoot, within(0, 1, ""), "at most this part of the step: 0.05 is 5 %");
  limit("--rise-time", Quantity::rise_time, within(1e-3, 100, ""), "from 10 to 90 % within [s]");
  limit("--rms-voltage", Quantity::rms_voltage, within(1e-6, 1e6, ""), "over the whole test at most [V]");
  limit("--peak-voltage", Quantity::peak_voltage, within(1e-6, 1e6, ""), "at most [V]");
  limit("--bandwidth", Quantity::bandwidth, within(1e-3, 1e4, ""), "closed loop, -3 dB, at least [Hz]");
  command.add_option("--law", o.law, "pd or pid")->capture_default_str()->check(CLI::IsMember({"pd", "pid"}));
  command.add_option("--step", o.step_m, "size of the step, either sign [m]")
      ->capture_default_str()
      ->check(within(-100, 100, ""));
  command.add_option("--start", o.start_m, "where it begins [m]")
      ->capture_default_str()
      ->check(within(-100, 100, ""));
  command.add_option("--duration", o.duration_s, "length of the test [s]; three times the times asked for")
      ->check(within(0.01, 200, ""));
  auto* rig = command.add_option("--rig", o.rig, "rig file: rate, voltage limit, encoder, travel");
  command.add_option("--session", o.session, "take them from the session in this directory")->excludes(rig);
  command.add_option("--rate", o.rate_hz, "sample rate [Hz]; 1000 where nothing says otherwise")
      ->check(within(10, 1e5, ""));
  command.add_option("--voltage-limit", o.voltage_limit_V, "limit of the command [V]; 12")
      ->check(within(1e-3, 1e6, ""));
  command.add_option("--encoder", o.encoder_m, "resolution [m]; 0 does not round")->check(within(0, 1, ""));
  command.add_option("--filter", o.filter_hz, "corner of the derivative filter [Hz]; 50")
      ->check(within(0.1, 2000, ""));
  command.add_option("--derivative-on", o.derivative_on, "error or measurement")
      ->capture_default_str()
      ->check(CLI::IsMember({"error", "measurement"}));
  command.add_flag("--ideal", o.ideal,
                   "the continuous law of Eq. 62: no limit, filter, encoder or kick at the step");
  command.add_option("--kp", o.kp, "proportional gain, or range LEAST:MOST to search [V/m]");
  command.add_option("--kd", o.kd, "derivative gain, or range LEAST:MOST to search [V s/m]");
  command.add_option("--ki", o.ki, "pid: integral gain [V/(m s)]; searched through Ki = Kp/Ti where absent");
  command.add_option("--margin", o.margin, "part of every limit to keep in the worst case")
      ->capture_default_str()
      ->check(within(0, 0.9, ""));
  command.add_option("--gain-change", o.gain_change, "part by which the gains may be off")
      ->capture_default_str()
      ->check(within(0, 0.5, ""));
  command.add_option("--relay", o.relay,
                     "session with dual-relay recordings for the tuning rules; simulated where absent");
  command.add_option("--out", o.out, "gain file to write (TOML), for `cartwright device gains flash`");
  command.add_option("--report", o.report, "page to write (HTML): map, response with band, rules");
  o.threads = std::max(1u, std::thread::hardware_concurrency());
  command.add_option("--threads", o.threads, "threads to use")
      ->capture_default_str()
      ->check(CLI::Range(1u, 256u));
  command.add_flag("--json", o.json, "print one JSON object instead of the table");
}

Result<DesignTask> design_task(const DesignOptions& o, const CLI::App& command) {
  if (const auto fits = check_ideal(o, command); !fits) return tl::unexpected(fits.error());
  if (std::none_of(o.limits.begin(), o.limits.end(), [](const auto& limit) { return limit.has_value(); })) {
    return failure(
        "nothing is specified: give --settling-time, --overshoot, --rise-time, --rms-voltage, --peak-voltage "
        "or --bandwidth");
  }
  if (o.step_m == 0) return failure("--step 0 is no step: give a size in m");
  if (o.law == "pd" && !o.ki.empty()) return failure("--ki belongs to --law pid");
  const auto file = read_model_with_intervals(o.model);
  if (!file) return tl::unexpected(file.error());
  if (!(file->model[Parameter::voltage_gain] > 0)) {
    return failure(
        fmt::format("{}: voltage_gain_m_per_s2_V = {} drives away from the reference; it must be above zero",
                    o.model, file->model[Parameter::voltage_gain]));
  }
  const auto rig = rig_of(o);
  if (!rig) return tl::unexpected(rig.error());
  design::Loop loop;
  if (o.ideal) {
    loop = design::Loop::continuous();
  } else {
    loop.period_s = rig->period_s();
    loop.voltage_limit_V = rig->voltage_limit_V;
    loop.encoder_resolution_m = rig->encoder_resolution_m;
    loop.derivative_filter_hz = o.filter_hz.value_or(loop.derivative_filter_hz);
    loop.derivative_on_measurement = o.derivative_on == "measurement";
  }
  const auto spec = specification_of(o);
  const design::StepTest step = step_of(o);
  if (step.duration_s < 10 * loop.period_s)
    return failure("--duration is less than ten ticks at this --rate");
  const bool integral = o.law == "pid";
  auto search = design::default_search(file->model, loop, step, spec, integral);
  const double most_kp = wire::info(wire::Id::staged_kp_V_per_m).most;
  const double most_kd = wire::info(wire::Id::staged_kd_V_s_per_m).most;
  search.kp = {std::min(search.kp.least, 0.1 * most_kp), std::min(search.kp.most, most_kp)};
  search.kd.most = std::min(search.kd.most, most_kd);
  for (const auto& [text, option, most, into] :
       {std::tuple{&o.kp, "--kp", most_kp, &search.kp}, {&o.kd, "--kd", most_kd, &search.kd}}) {
    if (text->empty()) continue;
    const auto read = range(*text, option, most);
    if (!read) return tl::unexpected(read.error());
    *into = *read;
  }
  if (!o.ki.empty()) {
    const auto ki = number(o.ki, "--ki");
    if (!ki) return tl::unexpected(ki.error());
    if (*ki < 0) return failure("--ki must not be negative");
    search.integrals = {{0, *ki}};
  }
  // One gain alone is cheap to look at closely.
  if (search.kp.fixed() || search.kd.fixed()) search.quarters = 100;
  search.margin = o.margin;
  search.gain_change = o.gain_change;
  search.threads = o.threads;
  return DesignTask{file->model,
                    file->intervals,
                    o.rig.empty() && o.session.empty() ? std::string() : rig->name,
                    design::Trials(design::sample_scenarios(file->model, file->intervals), loop, step, spec),
                    search,
                    integral};
}

}  // namespace cartwright::cli
