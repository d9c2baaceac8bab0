#include "common/model/model.hpp"

namespace cartwright {

Model::Model() {
  for (const ParameterInfo& parameter : parameters()) {
    values_[static_cast<std::size_t>(parameter.id)] = parameter.default_value.value_or(0.0);
  }
}

Model& Model::set(Parameter parameter, double value) {
  values_[static_cast<std::size_t>(parameter)] = value;
  if (const auto& term = info(parameter).term) add(*term);
  return *this;
}

std::string dotted_name(Parameter parameter) {
  const ParameterInfo& entry = info(parameter);
  std::string name;
  if (entry.term) name.append(info(*entry.term).name).append(".");
  return name.append(entry.key);
}

}  // namespace cartwright
