#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

RigFile with_resolution(RigFile file) {
  if (file.rig.encoder_resolution_m == 0) file.rig.encoder_resolution_m = 2.275e-5;
  return file;
}

hal::sim::CartSetup setup_of(const Model& model, const RigFile& file) {
  hal::sim::CartSetup setup;
  setup.model = model;
  setup.encoder_resolution_m = file.rig.encoder_resolution_m;
  setup.low_end_m = file.rig.travel_m[0] - file.end_stop_m;
  setup.high_end_m = file.rig.travel_m[1] + file.end_stop_m;
  setup.start_position_m = file.start_position_m;
  return setup;
}

const RigFile& standard_file() {
  static const RigFile file;
  return file;
}

}  // namespace

TestRig::TestRig(const Model& model) : TestRig(model, standard_file()) {}

TestRig::TestRig(const Model& model, const RigFile& file, std::size_t log_rows)
    : rig(with_resolution(file)),
      cart(setup_of(model, rig)),
      exchange(std::make_unique<Exchange>(log_rows)),
      controller(controller_setup(rig), cart.devices(), *exchange),
      loop(controller, pacer, kPeriod_ns, telemetry) {}

}  // namespace cartwright::firmware
