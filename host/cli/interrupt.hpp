#pragma once

namespace cartwright::cli {

/// While alive, Ctrl-C does not end the program but is remembered, so that a running experiment can be
/// stopped properly. A second Ctrl-C ends it.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  bool requested() const;
};

}  // namespace cartwright::cli
