#include "firmware/compensation_setup.hpp"

#include "common/wire/model_registers.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;

Model model_from(const Settings& settings) {
  Model model(0);
  for (const auto& [parameter, id] : wire::kModelRegisters) {
    if (settings[id] == wire::info(id).initial) continue;
    const auto& term = info(parameter).term;
    if (!term) {
      model.set(parameter, settings[id]);
      continue;
    }
    for (const auto& [other, its_id] : wire::kModelRegisters) {
      if (info(other).term == term) model.set(other, settings[its_id]);
    }
  }
  return model;
}

AdaptiveSettings adaptive_from(const Settings& settings, const Model& model, const RigFile& rig) {
  AdaptiveSettings out;
  out.lambda1_per_s2 = settings[Id::adaptive_lambda1_per_s2];
  out.lambda2_per_s = settings[Id::adaptive_lambda2_per_s];
  out.kv_per_s = settings[Id::adaptive_kv_per_s];
  out.speed_filter_hz = settings[Id::adaptive_speed_filter_hz];
  out.fastest_per_s = settings[Id::adaptive_fastest_per_s];
  out.leakage_per_s = settings[Id::adaptive_leakage_per_s];
  out.rate.value = {settings[Id::adaptive_ka], settings[Id::adaptive_kb], settings[Id::adaptive_kf1],
                    settings[Id::adaptive_kf2], settings[Id::adaptive_kf]};
  out.measured_velocity = settings.flag(Id::adaptive_measured_velocity);
  out.own_feedback = settings.flag(Id::adaptive_own_feedback);
  out.dead_zone_m_per_s = settings[Id::adaptive_dead_zone_m_per_s];
  if (out.dead_zone_m_per_s == 0) {
    out.dead_zone_m_per_s = quiet_dead_zone_m_per_s(out, rig.rig.encoder_resolution_m, rig.rig.period_s());
  }
  return adaptive_about(model, out, settings[Id::adaptive_range], rig.rig.voltage_limit_V);
}

}  // namespace

Result<CompensationSetup> compensation_from(const Settings& settings, const RigFile& rig) {
  const Model model = model_from(settings);
  CompensationSettings out;
  out.mode = static_cast<CompensationMode>(settings.integer(Id::compensation_mode));
  if (out.mode != CompensationMode::off && !(model[Parameter::voltage_gain] > 0)) {
    return failure("friction compensation needs a model: model_voltage_gain_m_per_s2_V is 0");
  }
  out.model = model;
  out.limit_V = settings[Id::compensation_limit_V];
  out.adaptive = adaptive_from(settings, model, rig);
  return CompensationSetup{Compensation::prepare(out, rig.rig.period_s()), PlantTerms(model, false)};
}

void put_model(Settings& settings, const Model& model) {
  for (const auto& [parameter, id] : wire::kModelRegisters) {
    const auto& term = info(parameter).term;
    settings.set(id, !term || model.has(*term) ? model[parameter] : wire::info(id).initial);
  }
}

}  // namespace cartwright::firmware
