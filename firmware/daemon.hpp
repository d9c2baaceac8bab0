#pragma once

#include <string>
#include <vector>

#include "common/result.hpp"
#include "firmware/rig_file.hpp"
#include "hal/interface/stage.hpp"

namespace cartwright::firmware {

/// What the command line asks for.
struct Options {
  std::string rig_file;
  bool virtual_time = false;
  int port = -1;  ///< -1: the rig file's
  std::string once, out;
  std::vector<std::string> settings;  ///< NAME=VALUE
};

/// The rig file that the options name, with what they override.
Result<RigFile> load_rig(const Options& options);

/// Runs the controller on these devices: serves until SIGTERM or SIGINT, or makes the recordings of one
/// experiment and leaves. Returns the exit status, or what made its input unusable.
Result<int> run(const Options& options, const RigFile& rig, const hal::Devices& devices);

}  // namespace cartwright::firmware
