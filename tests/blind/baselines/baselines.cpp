#include "tests/blind/baselines/baselines.hpp"

#include <algorithm>

#include "tests/blind/baselines/sparse.hpp"

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
          {"single split", single_split(session, nominal)},
          {"STLSQ, derivatives", sparse_by_derivatives(session, nominal)},
          {"STLSQ, weak form", sparse_in_weak_form(session, nominal)}};
}

std::vector<std::string> baseline_descriptions() {
  return {
      "most gain: the term that gains most likelihood over the refitted nominal model, whatever it gains; it "
      "names one and never refuses",
      "BIC: the same fits, a term added while the Bayesian information criterion falls, every row counted as "
      "independent; at most two",
      "BIC of windows: the same criterion on errors of simulated 0.5 s windows",
      "single split: fitted to every other recording, the term with the least window error on the rest",
      "STLSQ, derivatives: sparse regression of smoothed second differences on the vocabulary as a library "
      "of "
      "columns, threshold cross-validated; hidden states and single events have no column",
      "STLSQ, weak form: the same integrated against bumps of 100 ms, nothing differentiated twice",
  };
}

}  // namespace cartwright::blind
