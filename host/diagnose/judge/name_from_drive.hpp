#pragma once

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// Whether a drive's lines may be called cogging: they explain most of what the drive does besides friction
/// in quarters of the way that were not used, and no line over time explains clearly more.
bool names_cogging(const DriveBalance& drive);

/// Names the cogging that the drive of a held speed balances: the nominal model as it was given (such a
/// session tells none of its numbers but friction at that speed), with up to three waves of
///
///     push(y) = -beta height sin(2 pi y/period + phase),
///
/// beta being the nominal voltage gain. Sets verdict, model, effect and the numbers of the nominal terms.
void name_from_drive(const DriveBalance& drive, const Model& nominal, Diagnosis& diagnosis);

/// What the lines leave of the drive, in one sentence.
std::string statement_of_lines(const DriveBalance& drive);

/// Why they were read from the drive, what they leave, and what that cannot tell, in words.
std::string statement_of_drive(const DriveBalance& drive);

}  // namespace cartwright
