#include "firmware/rig_file_compensation.hpp"

#include <fmt/format.h>

#include "common/config/model_toml.hpp"
#include "common/files/files.hpp"
#include "common/wire/model_registers.hpp"
#include "firmware/compensation_setup.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;

bool is_setting(Id id) {
  return id == Id::compensation_limit_V || (id >= Id::adaptive_range && id <= Id::adaptive_own_feedback);
}

Result<void> read_model(Settings& out, const TomlReader& table, const std::filesystem::path& directory) {
  if (!table.has("model")) return {};
  const auto name = table.required_text("model", "a model file");
  if (!name) return tl::unexpected(name.error());
  const std::filesystem::path file = directory / *name;
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto model = model_from_toml(*text, file.string());
  if (!model) return tl::unexpected(model.error());
  put_model(out, *model);
  return {};
}

}  // namespace

Result<void> read_compensation(Settings& out, const TomlReader& root,
                               const std::filesystem::path& directory) {
  const auto section = root.table("compensation");
  if (!section) return tl::unexpected(section.error());
  if (!*section) return {};
  const TomlReader& table = **section;
  for (const auto& [key, value] : table.raw()) {
    const auto id = wire::find_register(key.str());
    if (key == "mode" || key == "model" || (id && is_setting(*id))) continue;
    return failure(
        fmt::format("{}: unknown key {} in [compensation]; it takes mode, model, compensation_limit_V and "
                    "the adaptive_ registers",
                    table.where(key.str()), key.str()));
  }
  for (const wire::Register& r : wire::registers()) {
    if (!is_setting(r.id) || !table.has(r.name)) continue;
    const auto value = table.number(r.name, r.initial, r.least, r.most);
    if (!value) return tl::unexpected(value.error());
    out.set(r.id, *value);
  }
  if (const auto model = read_model(out, table, directory); !model) return model;
  const auto mode = table.text("mode", "off");
  if (!mode) return tl::unexpected(mode.error());
  for (const double number : {0.0, 1.0, 2.0}) {
    if (*mode == wire::kCompensationNames[static_cast<std::size_t>(number)]) {
      out.set(Id::compensation_mode, number);
      if (number > 0 && !(out[Id::model_voltage_gain_m_per_s2_V] > 0)) {
        return failure(fmt::format("{}: mode = \"{}\" needs model = \"FILE\", the identified model",
                                   table.where("mode"), *mode));
      }
      return {};
    }
  }
  return failure(
      fmt::format("{}: mode must be \"off\", \"feedforward\" or \"adaptive\"", table.where("mode")));
}

}  // namespace cartwright::firmware
