#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "common/config/model_toml.hpp"
#include "common/control/feedforward.hpp"
#include "common/files/files.hpp"
#include "common/wire/model_registers.hpp"
#include "host/cli/device_command.hpp"
#include "host/device/compensation.hpp"

namespace cartwright::cli {
namespace {

using nlohmann::ordered_json;
using wire::Id;

struct Options {
  std::string mode, model;
  std::vector<std::string> set;
  bool json = false;
};

std::string_view mode_name(unsigned mode) {
  return mode < wire::kCompensationNames.size() ? wire::kCompensationNames[mode] : "unknown";
}

std::vector<std::string> names(const std::vector<Term>& terms) {
  std::vector<std::string> out;
  for (const Term term : terms) out.emplace_back(info(term).name);
  return out;
}

bool may_be_set(const wire::Register& what) {
  return what.id == Id::compensation_limit_V ||
         (what.id >= Id::adaptive_range && what.id <= Id::adaptive_own_feedback);
}

Result<std::vector<device::Setting>> settings_from(const std::vector<std::string>& entries) {
  std::vector<device::Setting> out;
  for (const std::string& entry : entries) {
    const auto equals = entry.find('=');
    const auto id = wire::find_register(entry.substr(0, equals));
    if (equals == std::string::npos || !id || !may_be_set(wire::info(*id))) {
      return failure(
          fmt::format("--set {}: NAME=NUMBER is needed, with compensation_limit_V or a register whose name "
                      "starts with adaptive_",
                      entry));
    }
    double value = 0;
    try {
      std::size_t used = 0;
      value = std::stod(entry.substr(equals + 1), &used);
      if (used != entry.size() - equals - 1) value = std::nan("");
    } catch (const std::exception&) {
      value = std::nan("");
    }
    const wire::Register& what = wire::info(*id);
    if (!(value >= what.least && value <= what.most)) {
      return failure(fmt::format("--set {}: a number from {} to {} is needed", entry, what.least, what.most));
    }
    out.emplace_back(*id, value);
  }
  return out;
}

ordered_json to_json(const device::RegisterBlock& live, const std::vector<Term>* ignored) {
  const auto number = [&live](Id id) {
    const double value = live.value(id);
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  };
  ordered_json out = {{"mode", mode_name(live.integer<unsigned>(Id::live_compensation))},
                      {"voltage_V", number(Id::live_compensation_V)},
                      {"estimates", ordered_json::object()},
                      {"limits_met", live.integer<unsigned>(Id::estimate_limits)}};
  for (auto i = static_cast<std::size_t>(Id::estimate_a_V_s_per_m);
       i <= static_cast<std::size_t>(Id::estimate_f_V); ++i) {
    const wire::Register& what = wire::registers()[i];
    out["estimates"][std::string(what.name.substr(std::string_view("estimate_").size()))] = number(what.id);
  }
  if (ignored) out["ignored_terms"] = names(*ignored);
  return out;
}

void print_text(const device::RegisterBlock& live, const std::vector<Term>* ignored) {
  fmt::print("compensation {}\n", mode_name(live.integer<unsigned>(Id::live_compensation)));
  if (ignored && !ignored->empty()) {
    fmt::print("left out, no inverse: {}\n", fmt::join(names(*ignored), ", "));
  }
  for (auto i = static_cast<std::size_t>(Id::estimate_a_V_s_per_m);
       i <= static_cast<std::size_t>(Id::estimate_f_V); ++i) {
    const wire::Register& what = wire::registers()[i];
    if (std::isfinite(live.value(what.id))) fmt::print("{:<22} {:.6g}\n", what.name, live.value(what.id));
  }
}

Outcome run(const device::Address& address, const Options& options) {
  std::vector<device::Setting> settings;
  std::vector<Term> ignored;
  if (!options.model.empty()) {
    const auto model = read_file(options.model).and_then([&](const std::string& text) {
      return model_from_toml(text, options.model);
    });
    if (!model) return tl::unexpected(model.error());
    settings = device::model_settings(*model);
    ignored = without_inverse(*model);
  }
  const auto set = settings_from(options.set);
  if (!set) return tl::unexpected(set.error());
  settings.insert(settings.end(), set->begin(), set->end());
  for (std::size_t mode = 0; mode < wire::kCompensationNames.size(); ++mode) {
    if (options.mode == wire::kCompensationNames[mode]) {
      settings.emplace_back(Id::compensation_mode, static_cast<double>(mode));
    }
  }

  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  if (!settings.empty()) {
    if (const auto written = controller->write(settings); !written) return conclude(written.error());
    if (const auto done = controller->command(wire::Command::set_compensation); !done)
      return conclude(done.error());
  }
  const auto live = controller->read(Id::live_compensation, Id::estimate_limits);
  if (!live) return conclude(live.error());
  const std::vector<Term>* const left_out = options.model.empty() ? nullptr : &ignored;
  if (options.json) {
    fmt::print("{}\n", to_json(*live, left_out).dump(2));
  } else {
    print_text(*live, left_out);
  }
  return Status::done;
}

}  // namespace

void add_device_compensation(CLI::App& device, int& exit_status) {
  CLI::App* command = device.add_subcommand("compensation", "Show or switch the compensation of friction");
  command->footer(
      "Without MODE, --model and --set it shows what is active. The change happens between two\n"
      "ticks, without a bump, also while an experiment runs. Model and settings stay with the\n"
      "controller until it ends; [compensation] in the rig file holds them for longer. Terms of\n"
      "the model that have no inverse are left out, and named.\n\n"
      "Examples:\n"
      "  cartwright device compensation feedforward --model model.toml\n"
      "  cartwright device compensation adaptive --set adaptive_kf1=10\n"
      "  cartwright device compensation off\n"
      "  cartwright device compensation --json");
  const auto address = add_address(command);
  auto options = std::make_shared<Options>();
  command->add_option("MODE", options->mode, "off, feedforward or adaptive")
      ->check(CLI::IsMember(
          std::set<std::string>(wire::kCompensationNames.begin(), wire::kCompensationNames.end())));
  command->add_option("--model", options->model, "model file, as cartwright identify writes it");
  command->add_option("--set", options->set,
                      "NAME=NUMBER of compensation_limit_V or an adaptive_ register; see cartwrightd "
                      "--registers");
  command->add_flag("--json", options->json, "one JSON object on standard output");
  on_run(command, exit_status, [address, options] { return run(*address, *options); });
}

}  // namespace cartwright::cli
