#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/diagnose/locate/locate.hpp"

namespace cartwright {

/// Axis name to the widest stretch [low, high] on which the missing push stands outside its band; empty:
/// flat.
using Where = std::map<std::string, std::vector<double>>;

/// The axes of diagnosis.json, from a location map.
Where where_of(const Location& location);

/// Where an effect acts that the maps of all recordings together are too coarse for: a push is at its time.
Where where_of(Term effect, const Model& model, const Location& location);

/// Gain of the structure that a location map still shows, in nats.
double structure_left(const Location& location);

}  // namespace cartwright
