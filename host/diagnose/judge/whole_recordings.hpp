#pragma once

#include <optional>
#include <vector>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// The model with those of its numbers that act slowly refitted to whole recordings, simulated from their
/// voltage (host/identify/simulation_fit.hpp). Where much of what is missing has no name, that is the better
/// fit: the likelihood of errors over one step takes what it has no name for as noise and hardly knows slow
/// pushes, which add up in every prediction. None where 0.5 s windows get worse by more, as a ratio, than
/// whole recordings get better, or nothing can be simulated.
std::optional<Model> fitted_to_whole_recordings(const Model& model, const Session& session,
                                                const std::vector<Parameter>& held, unsigned threads);

}  // namespace cartwright
