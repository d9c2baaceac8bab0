#pragma once

#include "host/diagnose/diagnosis.hpp"
#include "host/report/report.hpp"

namespace cartwright {

/// The diagnosis as a page: the verdict in one sentence, then one section a question: where, what, how much
/// better, what else could it be, what to measure next.
report::Report diagnosis_page(const Diagnosis& diagnosis, const Session& session, const Model& nominal);

}  // namespace cartwright
