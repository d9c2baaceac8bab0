#include "common/config/model_toml.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>

#include "common/config/toml_text.hpp"

namespace cartwright {
namespace {

std::string where(std::string_view source, const toml::source_region& region) {
  return fmt::format("{}:{}", source, region.begin.line);
}

std::string keys_of(Term term) {
  std::string list;
  for (const ParameterInfo& parameter : parameters_of(term)) {
    if (!list.empty()) list += ", ";
    list += parameter.key;
  }
  if (term == Term::external_disturbance) list = "recording, " + list;
  return list;
}

Result<double> number(const toml::node& node, const ParameterInfo& parameter, std::string_view source) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  const std::string name = dotted_name(parameter.id);
  if (!value || !std::isfinite(*value)) {
    return failure(fmt::format("{}: {} must be a finite number", where(source, node.source()), name));
  }
  if (*value < parameter.lower || *value > parameter.upper) {
    return failure(fmt::format("{}: {} = {} is outside [{}, {}]", where(source, node.source()), name, *value,
                               parameter.lower, parameter.upper));
  }
  return *value;
}

Result<void> read_term(Model& model, Term term, const toml::table& table, std::string_view source) {
  model.add(term);
  for (const ParameterInfo& parameter : parameters_of(term)) {
    const toml::node* node = table.get(parameter.key);
    if (!node) {
      if (parameter.default_value) continue;
      return failure(fmt::format("{}: [model.{}] lacks {} ({})", where(source, table.source()),
                                 info(term).name, parameter.key, parameter.meaning));
    }
    const Result<double> value = number(*node, parameter, source);
    if (!value) return tl::unexpected(value.error());
    model.set(parameter.id, *value);
  }
  for (const auto& [key, node] : table) {
    const bool recording = term == Term::external_disturbance && key == "recording";
    if (recording) {
      model.disturbance_recording = node.value_or(std::string{});
      if (!node.is_string()) {
        return failure(fmt::format("{}: external_disturbance.recording must be a file name in quotes",
                                   where(source, node.source())));
      }
    } else if (!find_parameter(fmt::format("{}.{}", info(term).name, key.str()))) {
      return failure(fmt::format("{}: unknown key {} in [model.{}]; it has {}", where(source, key.source()),
                                 key.str(), info(term).name, keys_of(term)));
    }
  }
  if (model[Parameter::presliding_damping_ratio] > 0 && model[Parameter::presliding_dahl_exponent] == 0) {
    return failure(
        fmt::format("{}: presliding_friction.damping_ratio needs dahl_exponent > 0: an elastic "
                    "bristle has no damping",
                    where(source, table.source())));
  }
  return {};
}

}  // namespace

Result<Model> model_from_toml(std::string_view text, std::string_view source) {
  toml::table document;
  try {
    document = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("{}: {}", where(source, error.source()), error.description()));
  }
  const toml::table* table = document["model"].as_table();
  if (!table) return failure(fmt::format("{}: no [model] table", source));
  Model model;
  const ParameterInfo& gain = info(Parameter::voltage_gain);
  const toml::node* gain_node = table->get(gain.key);
  if (!gain_node) return failure(fmt::format("{}: [model] lacks {}", source, gain.key));
  const Result<double> beta = number(*gain_node, gain, source);
  if (!beta) return tl::unexpected(beta.error());
  model.set(Parameter::voltage_gain, *beta);
  for (const auto& [key, node] : *table) {
    if (key == gain.key) continue;
    const auto term = find_term(key.str());
    if (!term || !node.is_table()) {
      return failure(fmt::format("{}: unknown {} [model.{}]; the vocabulary is in cartwright-model(5)",
                                 where(source, key.source()), node.is_table() ? "term" : "key", key.str()));
    }
    const Result<void> read = read_term(model, *term, *node.as_table(), source);
    if (!read) return tl::unexpected(read.error());
  }
  return model;
}

std::string to_toml(const Model& model) {
  const ParameterInfo& gain = info(Parameter::voltage_gain);
  std::string text = fmt::format("[model]\n{} = {}\n", gain.key, model[gain.id]);
  for (const TermInfo& term : terms()) {
    if (!model.has(term.id)) continue;
    text += fmt::format("\n[model.{}]\n", term.name);
    if (term.id == Term::external_disturbance) {
      text += fmt::format("recording = {}\n", toml_text(model.disturbance_recording));
    }
    for (const ParameterInfo& parameter : parameters_of(term.id)) {
      if (parameter.default_value && model[parameter.id] == *parameter.default_value) continue;
      text += fmt::format("{} = {}\n", parameter.key, model[parameter.id]);
    }
  }
  return text;
}

}  // namespace cartwright
