#pragma once

#include <string>

namespace cartwright::cli {

/// A bar on standard error, and only where that is a terminal. Gone without a trace at the end.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `part` of the work is done, 0 to 1. Cheap enough to call often.
  void show(double part);
  void label(std::string text) { label_ = std::move(text); }

 private:
  std::string label_, drawn_;
  bool visible_;
};

}  // namespace cartwright::cli
