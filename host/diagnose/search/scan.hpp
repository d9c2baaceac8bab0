#pragma once

#include <optional>
#include <vector>

#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// Start values that no fixed list can hold, found in the errors of `base` by linear regression on what the
/// observer would have shown (influence.hpp), the base's own numbers refitted alongside. Each scan looks in
/// many places; the promise it returns is already less what the best of that many looks at noise would bring.

/// Cogging and encoder eccentricity: spatial frequencies up to the finest that speed and travel resolve.
std::vector<Promise> scan_periods(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads);

/// A further wave of the cogging that `base` has: what promises most away from the waves it has. None where
/// there are three.
std::optional<Promise> scan_further_wave(const Session& session, const Fit& base, const SessionFacts& facts,
                                         const FitOptions& options, unsigned threads);

/// A push in one recording: matched filter over start and duration. Where `base` has one, a further one in
/// its place.
std::vector<Promise> scan_pushes(const Session& session, const Fit& base, const SessionFacts& facts,
                                 const FitOptions& options);

/// A better start for a gap than `from`, whose promise said that one is worth looking for, with the noise it
/// was found with: its size with the mass in equal parts, then all its numbers, and how the mass is parted,
/// by evolution. None where with no share of the mass it is a count wide. `options` should take slopes over
/// kinks.
std::optional<Promise> scan_gaps(const Session& session, const Fit& base, const Promise& from,
                                 const SessionFacts& facts, const FitOptions& options, unsigned threads);

/// A sudden lasting step of the reading.
struct ReadingJump {
  std::size_t recording, row;
  double step_m;
};

/// Lost counts: steps of the reading that a matched filter finds, of at least two counts and far beyond
/// noise. Not within a push of `base`: where one begins and ends suddenly looks like steps.
std::vector<ReadingJump> scan_jumps(const Session& session, const Fit& base, const FitOptions& options);

/// Speed about a row, from readings 10 ms apart (one tick at least).
double velocity_at(const Recording& recording, std::size_t row);

/// The session with its readings put back where they would be had no counts been lost.
Session without_jumps(Session session, const std::vector<ReadingJump>& jumps);

}  // namespace cartwright
