#pragma once

#include <limits>
#include <string>
#include <vector>

#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/diagnose/search/explain.hpp"

namespace cartwright {

/// What one recording says for an effect: by how much likelier its readings are with the effect than without
/// it, everything else refitted [nats], and the spread of that over blocks of time.
struct RecordingSays {
  std::string file;
  double nats = 0, standard_error = 0;

  double z() const { return standard_error > 0 ? nats / standard_error : 0; }
};

/// What stands behind an effect, recording by recording and in predicted motion.
struct Support {
  std::vector<RecordingSays> recordings;
  /// Root-mean-square errors of 0.5 s windows [m]; NaN where nobody asked.
  double windows_with_m = std::numeric_limits<double>::quiet_NaN(), windows_without_m = windows_with_m;
  bool windows_get_worse = false;  ///< with it, beyond chance

  /// What the effect alone adds to the windows' errors, root mean square [m]; 0 where it lowers none.
  double windows_moved_m() const;
  /// How many recordings say so, each beyond chance (97.5 %).
  std::size_t recordings_for() const;
  bool most_say_so() const;  ///< of three recordings at least
};

/// Of each effect of the best explanation. The noise is taken to be that of the whole: what is missing
/// without an effect is then not taken for noise in recordings that do not show it. `windows` are those of
/// the whole.
std::vector<Support> support_of_effects(const Session& session, const Search& search,
                                        const std::vector<SquaredError>& windows, FitOptions options);

/// Of an effect that is there no recording says that it is not, beyond chance (1 % over all recordings): such
/// a recording loses by the effect what one must gain, and more than slightly another law would cost.
const RecordingSays* contradiction(const Support& support, double least_gain);

/// Empty, or why no effect is named: a recording contradicts one, or windows are predicted worse with it.
std::string unsupported(const std::vector<Contest>& effects, const std::vector<Support>& support,
                        double least_gain);

}  // namespace cartwright
