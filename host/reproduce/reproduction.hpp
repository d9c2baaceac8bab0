#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "host/report/plot.hpp"
#include "host/report/table.hpp"

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
  std::vector<report::Table> tables{};  ///< where an item a line would not do
  std::vector<report::Plot> plots{};
  int plot_columns = 2;
};

struct ReproduceOptions {
  int draws = 1000;  ///< noise draws of each sinefit example; the cart experiments take a tenth
  unsigned long seed = 1;
  std::function<void(double)> progress = [](double) {};  ///< share of the experiment that is done
};

/// A part of a paper that can be run alone.
struct Experiment {
  std::string key;  ///< short name on the command line
  std::string about;
  std::function<Result<Section>(const ReproduceOptions&)> run;
};

struct Paper {
  std::string key, title;
  std::vector<Experiment> experiments;
};

/// Wongvanich, Hann and Sirisena (2015), "Minimal modeling methodology to characterize non-linear damping in
/// an electromechanical system".
Paper damping_paper();

/// Dou and Chen, "Optimal features extraction of noisy sinusoidal signals"; Tan, Lee and others, "Friction
/// modeling and adaptive compensation using a relay feedback approach".
Paper relay_paper();

}  // namespace cartwright::reproduce
