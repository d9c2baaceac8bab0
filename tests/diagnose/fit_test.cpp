#include "host/diagnose/fit/fit.hpp"

#include <gtest/gtest.h>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/fit/candidates.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

/// With every recording of a session there twice, the second as a repeat of the first or of nothing.
Session twice(const Session& session, bool as_repeats) {
  Session out = session;
  for (Recording r : session.recordings) {
    r.repeat_of = as_repeats ? r.file : "";
    r.file += "_again";
    out.recordings.push_back(std::move(r));
  }
  return out;
}

double gain_error(const Session& session) {
  const Model start = test::nominal();
  const FitOptions options = options_for(session, start);
  return fit(session, start, {}, free_parameters(start, facts_of(session)), options)
      .standard_error(Parameter::voltage_gain);
}

TEST(Fit, ARepeatThatIsTheSameToTheLastCountSaysNothingNew) {
  Session session = test::battery({});
  std::erase_if(session.recordings, [](const Recording& r) { return !r.repeat_of.empty(); });
  const double once = gain_error(session);
  EXPECT_GT(once, 0);
  EXPECT_NEAR(gain_error(twice(session, true)), once, 0.02 * once);
  EXPECT_LT(gain_error(twice(session, false)), 0.8 * once);
}

TEST(Fit, NoiseIsNoSmallerThanWhatRoundingLeaves) {
  test::IndependentCart cart;
  cart.noise = 0, cart.coulomb_m_per_s2 = 1;  // stands most of the time, read without any error
  Session session = test::battery(cart);
  std::erase_if(session.recordings, [](const Recording& r) { return r.experiment != "step"; });
  const Model start = test::nominal(1.9, 5, 1);
  const Fit found =
      fit(session, start, search_noise(session, start), free_parameters(start, facts_of(session)));
  EXPECT_GE(found.error_rms_m, cart.count_m / std::sqrt(12));
  EXPECT_GE(robust_size(found), cart.count_m / std::sqrt(12));
}

TEST(Fit, ErrorsBelowRoundingTellHalfANatEachAtMost) {
  constexpr double kRows = 1000, kLeast_m2 = 4e-11;
  const double at_rounding = log_likelihood(kRows * kLeast_m2, kRows, kLeast_m2);
  EXPECT_NEAR(log_likelihood(0, kRows, kLeast_m2) - at_rounding, kRows / 2, 1e-6);
  EXPECT_NEAR(at_rounding - log_likelihood(4 * kRows * kLeast_m2, kRows, kLeast_m2), kRows * std::log(2),
              1e-6);
}

}  // namespace
}  // namespace cartwright
