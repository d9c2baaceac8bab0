#pragma once

#include "host/report/report.hpp"
#include "tests/blind/outcome.hpp"

namespace cartwright::blind {

/// The report of the benchmark: every measure beside its target and the baselines, the reliability of the
/// confidence, what can be detected and what cannot, each effect by itself, the time.
report::Report benchmark_page(const std::vector<Outcome>& outcomes);

}  // namespace cartwright::blind
