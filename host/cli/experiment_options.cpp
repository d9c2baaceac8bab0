#include "host/cli/experiment_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace cartwright::cli {
namespace {

using wire::Id;

/// Registers whose numbers have names.
const std::map<Id, std::map<std::string, double>>& words_of_registers() {
  static const std::map<std::string, double> kYesNo = {{"no", 0}, {"yes", 1}};
  static const std::map<Id, std::map<std::string, double>> kWords = {
      {Id::step_pattern, {{"single", 0}, {"alternating", 1}, {"ladder", 2}}},
      {Id::track_shape, {{"multisine", 0}, {"sine", 1}}},
      {Id::relay_stop, kYesNo},
      {Id::experiment_derivative_on_measurement, kYesNo},
  };
  return kWords;
}

std::string word_for(const std::map<std::string, double>& words, double value) {
  const auto found =
      std::find_if(words.begin(), words.end(), [value](const auto& entry) { return entry.second == value; });
  return found == words.end() ? std::string() : found->first;
}

std::vector<std::string> names_of(const std::map<std::string, double>& words) {
  std::vector<std::string> names;
  for (const auto& [name, value] : words) names.push_back(name);
  return names;
}

bool is_gain(Id id) {
  return id >= Id::experiment_kp_V_per_m && id <= Id::experiment_derivative_on_measurement;
}

}  // namespace

ExperimentOptions::ExperimentOptions(CLI::App* command, wire::ExperimentKind kind) : kind_(kind) {
  if (kind == wire::ExperimentKind::battery) return;  // it keeps its own
  const std::string prefix = fmt::format("{}_", wire::name(kind));
  for (const wire::Register& what : wire::registers()) {
    if (what.writable() && what.name.starts_with(prefix)) add(command, what, prefix);
  }
  add(command, wire::info(Id::experiment_duration_s), "experiment_");
  if (kind == wire::ExperimentKind::relay) return;  // its law has no PD gains
  for (const wire::Register& what : wire::registers()) {
    if (is_gain(what.id)) add(command, what, "experiment_");
  }
}

void ExperimentOptions::add(CLI::App* command, const wire::Register& what, std::string_view prefix) {
  std::string name = "--" + std::string(what.name.substr(prefix.size()));
  std::replace(name.begin(), name.end(), '_', '-');
  entries_.push_back({what.id, what.initial, nullptr});
  Entry& entry = entries_.back();
  const auto words = words_of_registers().find(what.id);
  const bool worded = words != words_of_registers().end();
  std::string help(what.meaning);
  if (is_gain(what.id)) help = help.substr(0, help.find(" for experiment_own_gains"));
  if (worded) {
    help += fmt::format(" (default {})", word_for(words->second, what.initial));
  } else if (is_gain(what.id)) {
    help += fmt::format(", {} to {} (default {} if another gain is given, else the active gains)", what.least,
                        what.most, what.initial);
  } else {
    help += fmt::format(", {} to {} (default {})", what.least, what.most, what.initial);
  }
  entry.option = command->add_option(name, entry.value, help);
  // The range stands in the help text; words are shown as the type, from where the completion takes them.
  if (worded) {
    CLI::CheckedTransformer transformer(words->second);
    transformer.description(fmt::format("{{{}}}", fmt::join(names_of(words->second), ",")));
    entry.option->transform(transformer)->type_name("");
  } else {
    CLI::Range range(what.least, what.most);
    range.description("");
    entry.option->check(range)->type_name("NUMBER");
  }
  if (is_gain(what.id)) entry.option->group("Gains");
}

std::vector<device::Setting> ExperimentOptions::settings() const {
  std::vector<device::Setting> settings = {{Id::experiment_kind, static_cast<double>(kind_)}};
  bool own_gains = false;
  for (const Entry& entry : entries_) {
    settings.emplace_back(entry.id, entry.value);
    own_gains = own_gains || (is_gain(entry.id) && entry.option->count() > 0);
  }
  settings.emplace_back(Id::experiment_own_gains, own_gains ? 1 : 0);
  return settings;
}

}  // namespace cartwright::cli
