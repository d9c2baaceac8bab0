#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include "common/wire/register_map.hpp"
#include "firmware/daemon.hpp"
#include "hal/sim/simulated_cart.hpp"

namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  cartwrightd --rig simulated.toml                             serve a simulated cart in real time\n"
    "  cartwrightd --rig simulated.toml --virtual --port 0          in virtual time, on a free port\n"
    "  cartwrightd --rig simulated.toml --once battery --out demo   record the identification set and leave\n"
    "  cartwrightd --rig simulated.toml --virtual --once step --set step_amplitude_m=0.05 --out step\n"
    "  cartwrightd --registers                                      the register map as Markdown";

/// The one place that chooses devices. A real rig is refused when its file is read: this version has none.
cartwright::hal::sim::CartSetup cart_setup(const cartwright::firmware::RigFile& rig) {
  cartwright::hal::sim::CartSetup setup;
  setup.model = rig.model;
  setup.encoder_resolution_m = rig.rig.encoder_resolution_m;
  setup.amplifier_limit_V = rig.rig.voltage_limit_V;
  setup.low_end_m = rig.rig.travel_m[0] - rig.end_stop_m;
  setup.high_end_m = rig.rig.travel_m[1] + rig.end_stop_m;
  setup.start_position_m = rig.start_position_m;
  setup.seed = rig.seed;
  return setup;
}

cartwright::Result<int> start(const cartwright::firmware::Options& options) {
  const auto rig = cartwright::firmware::load_rig(options);
  if (!rig) return tl::unexpected(rig.error());
  cartwright::hal::sim::SimulatedCart cart(cart_setup(*rig));
  return cartwright::firmware::run(options, *rig, cart.devices());
}

}  // namespace

int main(int argc, char** argv) {
  using cartwright::firmware::Options;
  CLI::App app{"cartwrightd: the controller of a DC-motor cart"};
  app.name("cartwrightd");
  app.footer(kExamples);
  app.set_version_flag("--version", CARTWRIGHT_VERSION);
  Options options;
  bool registers = false;
  app.add_option("--rig", options.rig_file, "rig file (TOML)");
  app.add_flag("--virtual", options.virtual_time, "virtual time, whatever the rig file says");
  app.add_option("--port", options.port, "Modbus TCP port, 0 for a free one (default: the rig file's, 1502)")
      ->check(CLI::Range(0, 65535));
  CLI::Option* once =
      app.add_option("--once", options.once,
                     "run one experiment and leave: step, relay, track, sweep, dither, hold, battery");
  app.add_option("--out", options.out, "directory to write the recordings of --once to")->needs(once);
  app.add_option("--set", options.settings,
                 "NAME=VALUE of a register that can be written, for --once; see --registers")
      ->needs(once);
  app.add_flag("--registers", registers, "print the register map as Markdown and leave");
  try {
    app.parse(argc, argv);
    if (registers) {
      const std::string map = cartwright::wire::register_map_markdown();
      if (std::fputs(map.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return 0;
      std::fprintf(stderr, "cartwrightd: standard output cannot be written: %s\n", std::strerror(errno));
      return 2;
    }
    const auto outcome = start(options);
    if (outcome) return *outcome;
    std::fprintf(stderr, "cartwrightd: %s\n", outcome.error().message.c_str());
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "cartwrightd: %s; see cartwrightd --help\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cartwrightd: %s\n", error.what());
  }
  return 2;
}
