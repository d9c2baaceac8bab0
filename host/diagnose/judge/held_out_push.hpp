#pragma once

#include "host/diagnose/search/explanation.hpp"

namespace cartwright {

/// Recordings other than those an explanation was found with, what counts they lost put right: those steps of
/// the reading are found with the model as it stands.
Session put_right(const Session& out, const Explanation& best, const FitOptions& options);

/// What recordings that an explanation was not found with show of a push.
struct HeldOutPush {
  bool shows = false;       ///< more than chance, were it the only thing left
  bool stands_out = false;  ///< from what the recordings that were used show too: what a model misses
                            ///< everywhere looks like pushes
};
HeldOutPush push_in(const Session& out, const Session& used, const Explanation& best,
                    const FitOptions& options);

}  // namespace cartwright
