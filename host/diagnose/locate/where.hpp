#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/diagnose/locate/locate.hpp"

namespace cartwright {

/// Name of each axis of diagnosis.json to a stretch [low, high] of it; empty where none stands out.
using Where = std::map<std::string, std::vector<double>>;

/// No stretch of any axis.
Where nowhere();

/// Where something is missing: the widest stretches on which the missing push stands outside its band.
Where where_of(const Location& location);

/// Gain of the structure that a location map still shows, in nats.
double structure_left(const Location& location);

}  // namespace cartwright
