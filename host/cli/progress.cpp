#include "host/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace cartwright::cli {

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), visible_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (!drawn_.empty()) fmt::print(stderr, "\r\x1b[K");  // back to the start of the line, and clear it
}

void ProgressBar::show(double part) {
  if (!visible_) return;
  constexpr int kWidth = 30;
  part = std::clamp(part, 0.0, 1.0);
  const int full = static_cast<int>(part * kWidth);
  std::string line =
      fmt::format("{} [{:=<{}}{:{}}] {:3.0f} %", label_, "", full, "", kWidth - full, 100 * part);
  if (line == drawn_) return;
  drawn_ = std::move(line);
  fmt::print(stderr, "\r{}\x1b[K", drawn_);
  std::fflush(stderr);
}

}  // namespace cartwright::cli
