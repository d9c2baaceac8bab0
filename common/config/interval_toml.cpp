#include "common/config/interval_toml.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>

#include "common/config/toml_reader.hpp"

namespace cartwright {
namespace {

Result<std::optional<ParameterInterval>> interval(std::string_view name, const toml::node& node,
                                                  const std::string& where, const Model& model) {
  const auto id = find_parameter(name);
  if (!id) return failure(fmt::format("{}: \"{}\" in [intervals] is no parameter of a model", where, name));
  const auto term = info(*id).term;
  if (term && !model.has(*term)) {
    return failure(
        fmt::format("{}: \"{}\" in [intervals], but there is no [model.{}]", where, name, info(*term).name));
  }
  const toml::array* bounds = node.as_array();
  const auto bound = [&](std::size_t i) {
    const toml::node* one = bounds && bounds->size() == 2 ? bounds->get(i) : nullptr;
    return one && one->is_number() ? one->value<double>() : std::nullopt;
  };
  const auto low = bound(0), high = bound(1);
  if (!low || !high) return failure(fmt::format("{}: \"{}\" must be [low, high]", where, name));
  if (!std::isfinite(*low) || !std::isfinite(*high)) return std::nullopt;
  if (*low > *high) {
    return failure(fmt::format("{}: \"{}\" = [{}, {}]: low is above high", where, name, *low, *high));
  }
  return ParameterInterval{*id, *low, *high};
}

}  // namespace

Result<std::vector<ParameterInterval>> intervals_from_toml(std::string_view text, std::string_view source,
                                                           const Model& model) {
  const auto document = parse_toml(text, source);
  if (!document) return tl::unexpected(document.error());
  const TomlReader root(*document, std::string(source));
  const auto table = root.table("intervals");
  if (!table) return tl::unexpected(table.error());
  std::vector<ParameterInterval> found;
  if (!*table) return found;
  for (const auto& [key, node] : (*table)->raw()) {
    const auto one = interval(key.str(), node, (*table)->where(key.str()), model);
    if (!one) return tl::unexpected(one.error());
    if (*one) found.push_back(**one);
  }
  return found;
}

std::string intervals_to_toml(std::span<const ParameterInterval> intervals) {
  std::string text;
  for (const ParameterInterval& one : intervals) {
    if (!std::isfinite(one.low) || !std::isfinite(one.high)) continue;
    text += fmt::format("\"{}\" = [{}, {}]\n", dotted_name(one.id), one.low, one.high);
  }
  return text.empty() ? text : "\n# 95 % intervals of the fitted numbers\n[intervals]\n" + text;
}

}  // namespace cartwright
