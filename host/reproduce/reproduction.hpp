#pragma once

#include <string>
#include <vector>

#include "common/result.hpp"

namespace cartwright::reproduce {

/// One line: what a paper says, what comes out here, and why they differ. Only `published` is typed in.
struct Item {
  std::string item;
  std::string published;
  std::string obtained;
  std::string why;
};

struct Section {
  std::string heading;
  std::vector<Item> items;
};

struct PaperTable {
  std::string key;  ///< short name on the command line
  std::string title;
  std::vector<Section> sections;
};

struct ReproduceOptions {
  int draws = 1000;  ///< noise draws of each sinefit example
  unsigned long seed = 1;
};

/// Dou and Chen, "Optimal features extraction of noisy sinusoidal signals"; Tan, Lee and others, "Friction
/// modeling and adaptive compensation using a relay feedback approach".
Result<PaperTable> relay_paper(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
