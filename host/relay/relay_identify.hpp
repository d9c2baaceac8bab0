#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/relay/describing_function.hpp"
#include "host/relay/relay_match.hpp"

namespace cartwright {

/// A sum of parameters that the data gives where it does not give each of them.
struct Combination {
  std::vector<std::string> names;  ///< of the parameters, as in a model file or as in the paper
  std::string expression;
  Estimate estimate;
  std::string why;
};

struct RelayReport {
  struct Entry {
    std::string file;
    DualRelayGains gains;
    std::optional<LimitCycle> cycle;  ///< none where refused
    std::string refused;              ///< the reason
    double rms_m = 0;                 ///< left by the match
    std::vector<double> predicted_m;  ///< by the match; NaN outside the cycles
  };
  std::vector<Entry> recordings;

  struct Value {
    std::string name;  ///< as in a model file
    Estimate estimate;
  };
  std::vector<Value> parameters;  ///< what can be told apart
  std::vector<Combination> not_separable;
  /// The paper's terms: Tp/Kp [V s^2/m], f1 [V], 1/Kp + f2 [V s/m]; empty where c and F cannot be told apart.
  std::vector<Value> combinations;

  std::optional<RelayCombinations> corrected;    ///< describing function, two recordings or more
  std::optional<RelayFourParameters> published;  ///< as printed: three recordings, or Eq. (17) from two
};

/// Friction and dynamics from the dual-relay recordings of a session: every recording whose controller is a
/// dual relay is looked at, those without a steady limit cycle are refused with the reason, and the others
/// are matched together. Fails where none remains; the message then gives the reasons.
Result<RelayReport> identify_from_relay(const Session& session);

}  // namespace cartwright
