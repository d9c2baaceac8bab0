#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cartwright::test {

/// A directory of its own for one test; gone at the end.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return directory_ / name; }
  std::string text(const std::string& name) const { return (directory_ / name).string(); }
  /// Writes a file, and the directories it lies in.
  void put(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path directory_;
};

struct Finished {
  int status = -1;  ///< exit status; 128 + the signal that ended it
  std::string out, err;
};

/// Runs the `cartwright` that was built with this test, and waits for it.
Finished cartwright(const std::vector<std::string>& arguments);
Finished run(const std::string& program, const std::vector<std::string>& arguments);

/// `cartwrightd` on a port of its own, from its ready line to the end of the test.
class Daemon {
 public:
  /// A simulated cart in virtual time. `rig` is added to the [rig] table, `simulation` to [simulation].
  explicit Daemon(const std::string& rig = "", const std::string& simulation = "");
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  int port() const { return port_; }
  bool ready() const { return port_ > 0; }
  /// `cartwright device ARGUMENTS --port` this one.
  Finished device(std::vector<std::string> arguments) const;
  /// Ends it; gives its exit status.
  int stop();

 private:
  Scratch directory_;
  pid_t process_ = -1;
  int output_ = -1;
  int port_ = 0;
};

}  // namespace cartwright::test
