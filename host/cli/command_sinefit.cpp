#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/relay/sinefit.hpp"
#include "host/session/csv.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string file, column = "y_m";
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  SineFitOptions fit;
  bool json = false;
};

struct Samples {
  std::vector<double> t_s, y;
};

/// The rows within [from, to] whose cell is not empty.
Result<Samples> select(const CsvTable& table, const Options& options) {
  const auto t_s = table.required("t_s", options.file);
  if (!t_s) return tl::unexpected(t_s.error());
  const auto y = table.required(options.column, options.file);
  if (!y) return tl::unexpected(y.error());
  Samples samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = (**t_s)[row], value = (**y)[row];
    if (!std::isfinite(t)) {
      return failure(fmt::format("{}: t_s is not a finite number in data row {}", options.file, row + 1));
    }
    if (t < options.from_s || t > options.to_s || std::isnan(value)) continue;
    samples.t_s.push_back(t);
    samples.y.push_back(value);
  }
  return samples;
}

void print_json(const SineFit& fit) {
  nlohmann::ordered_json out = {{"amplitude", estimate_json(fit.amplitude)},
                                {"frequency_hz", estimate_json(fit.frequency_hz)},
                                {"phase_rad", estimate_json(fit.phase_rad)},
                                {"offset", estimate_json(fit.offset)},
                                {"rms", fit.rms},
                                {"rows", fit.residual.size()},
                                {"periods", fit.periods}};
  if (fit.trend_per_s) {
    out["trend_per_s"] = estimate_json(*fit.trend_per_s);
    out["middle_s"] = fit.middle_s;
  }
  for (const SineHarmonic& harmonic : fit.harmonics) {
    out["harmonics"].push_back({{"order", harmonic.order},
                                {"amplitude", estimate_json(harmonic.amplitude)},
                                {"phase_rad", estimate_json(harmonic.phase_rad)}});
  }
  fmt::print("{}\n", out.dump(2));
}

void print_line(const std::string& name, const Estimate& value) {
  if (value.has_interval()) {
    fmt::print("{:<14} {:>15.8g}   95 % within {:.8g} ... {:.8g}\n", name, value.value, value.low,
               value.high);
  } else {
    fmt::print("{:<14} {:>15.8g}\n", name, value.value);
  }
}

void print_text(const SineFit& fit, const std::string& column) {
  fmt::print("{} = offset + amplitude sin(2 pi frequency t + phase){}, {} rows, {:.2f} periods\n", column,
             fit.trend_per_s ? " + trend (t - middle)" : "", fit.residual.size(), fit.periods);
  print_line("amplitude", fit.amplitude);
  print_line("frequency_hz", fit.frequency_hz);
  print_line("phase_rad", fit.phase_rad);
  print_line("offset", fit.offset);
  if (fit.trend_per_s) {
    print_line("trend_per_s", *fit.trend_per_s);
    fmt::print("{:<14} {:>15.8g}\n", "middle_s", fit.middle_s);
  }
  for (const SineHarmonic& harmonic : fit.harmonics) {
    print_line(fmt::format("amplitude {}", harmonic.order), harmonic.amplitude);
    print_line(fmt::format("phase_rad {}", harmonic.order), harmonic.phase_rad);
  }
  fmt::print("{:<14} {:>15.8g}   of what is left\n", "rms", fit.rms);
}

Outcome run(const Options& options) {
  if (!(options.from_s < options.to_s)) {
    return failure(fmt::format("--from {} is not before --to {}", options.from_s, options.to_s));
  }
  const auto table = read_csv(options.file);
  if (!table) return tl::unexpected(table.error());
  const auto samples = select(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  const auto fit = sinefit(samples->t_s, samples->y, options.fit);
  if (!fit) return failure(fmt::format("{}: {}: {}", options.file, options.column, fit.error().message));
  if (options.json) {
    print_json(*fit);
  } else {
    print_text(*fit, options.column);
  }
  return Status::done;
}

}  // namespace

void add_sinefit(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("sinefit", "Fit a sine to a column: amplitude, frequency, phase, offset");
  command->footer(
      "Examples:\n"
      "  cartwright sinefit rig/monday/relay_a.csv --column y_m --from 4 --to 10\n"
      "  cartwright sinefit rig/monday/relay_a.csv --from 4 --harmonics 5 --json\n"
      "  cartwright sinefit rig/monday/track_a.csv --column y_m --frequency 0.5\n"
      "The time is the file's own, jitter and gaps included; rows with an empty cell are left out.");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "CSV file with t_s and the column")->required();
  command->add_option("--column", options->column, "column to fit")->capture_default_str();
  command->add_option("--from", options->from_s, "first time [s]; from the start if left out");
  command->add_option("--to", options->to_s, "last time [s]; to the end if left out");
  command->add_option("--frequency", options->fit.frequency_hz, "known frequency [Hz]; else it is found");
  command->add_option("--harmonics", options->fit.harmonics, "sines at 1 ... N times the frequency")
      ->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on standard output");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
