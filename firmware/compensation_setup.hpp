#pragma once

#include "common/control/compensation.hpp"
#include "common/result.hpp"
#include "firmware/rig_file.hpp"
#include "firmware/settings.hpp"

namespace cartwright::firmware {

/// What set_compensation hands to the loop, made ready outside it.
struct CompensationSetup {
  Compensation::Prepared law;
  PlantTerms model{Model(0), false};  ///< what the monitor holds recordings against; gain 0: none
};

/// From the registers compensation_mode and after. Fails where a mode is asked for without a model.
Result<CompensationSetup> compensation_from(const Settings& settings, const RigFile& rig);

/// The registers' values for a model; terms that the feed-forward cannot invert are left out.
void put_model(Settings& settings, const Model& model);

}  // namespace cartwright::firmware
