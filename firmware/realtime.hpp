#pragma once

#include <string>
#include <vector>

namespace cartwright::firmware {

/// What the operating system granted for a loop that keeps its deadlines.
struct Realtime {
  bool scheduler = false, memory = false, latency = false;
  std::vector<std::string> missing;  ///< one line each: what is missing and what it costs

  bool sufficient() const { return scheduler && memory; }
};

/// Locks memory and touches the stack, and keeps the processor out of deep sleep (/dev/cpu_dma_latency, held
/// open until the program ends). Call before threads start.
Realtime prepare_process();

/// Puts the calling thread under SCHED_FIFO; the rest of the process stays as it was.
void prepare_thread(Realtime& realtime);

}  // namespace cartwright::firmware
