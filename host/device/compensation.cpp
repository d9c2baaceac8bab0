#include "host/device/compensation.hpp"

#include "common/wire/model_registers.hpp"

namespace cartwright::device {

std::vector<Setting> model_settings(const Model& model) {
  std::vector<Setting> out;
  for (const auto& [parameter, id] : wire::kModelRegisters) {
    const auto& term = info(parameter).term;
    out.emplace_back(id, !term || model.has(*term) ? model[parameter] : wire::info(id).initial);
  }
  return out;
}

}  // namespace cartwright::device
