#include "host/cli/interrupt.hpp"

#include <csignal>

namespace cartwright::cli {
namespace {

volatile std::sig_atomic_t g_requested = 0;

void remember(int signal) {
  g_requested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  g_requested = 0;
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::requested() const {
  return g_requested != 0;
}

}  // namespace cartwright::cli
