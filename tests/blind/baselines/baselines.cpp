#include "tests/blind/baselines/baselines.hpp"

#include <algorithm>

namespace cartwright::blind {

std::map<std::string, Names> ask_baselines(const Session& session, const Model& nominal, const Diagnosis& d) {
  Session used = session;
  std::erase_if(used.recordings, [&](const Recording& r) {
    const auto& held = d.held_out_recordings;
    return std::find(held.begin(), held.end(), r.file) != held.end();
  });
  const OneRound first = one_round(used, d.search.refitted.fit, d.search.promises);
  return {{"most gain", most_gain(first)},
          {"BIC", stepwise_bic(used, first)},
          {"BIC of windows", bic_of_windows(used, first)},
          {"single split", single_split(session, nominal)}};
}

}  // namespace cartwright::blind
