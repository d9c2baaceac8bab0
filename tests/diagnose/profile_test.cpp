#include "host/diagnose/locate/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/judge/surrogate.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using test::battery;
using test::IndependentCart;

class Profiles : public testing::Test {
 protected:
  /// Looks at the errors of the nominal terms, refitted to the battery of a cart.
  void look_at(const IndependentCart& cart) {
    session_ = battery(cart);
    const Model start = test::nominal();
    options_.damping_per_s = linear_damping(start);
    const NoiseModel noise = search_noise(session_, start, options_);
    fit_ = fit(session_, start, noise, free_parameters(start, facts_of(session_)), options_);
    options_.outlier_m = 6 * robust_size(fit_);
  }

  Profile over_way() const { return spatial_frequency_profile(session_, fit_, options_, 2); }
  Profile over_frequency() const {
    return frequency_profile(session_, fit_, alike(session_, fit_, options_).error_m);
  }
  Profile over_lag() const { return input_lag_profile(session_, fit_); }

  Session session_;
  FitOptions options_;
  Fit fit_;
};

TEST_F(Profiles, AreFlatWhereNothingIsHidden) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    IndependentCart cart;
    cart.seed = seed;
    look_at(cart);
    EXPECT_TRUE(over_way().flat()) << seed;
    EXPECT_TRUE(over_frequency().flat()) << seed;
    EXPECT_TRUE(over_lag().flat()) << seed;
  }
}

TEST_F(Profiles, APushThatRepeatsOverTheWayStandsAtItsSpatialFrequency) {
  constexpr double kPeriod_m = 0.021;
  IndependentCart cart;
  cart.push = [](double, double y, double) { return 0.2 * std::sin(2 * M_PI * y / kPeriod_m + 1); };
  look_at(cart);
  const Profile profile = over_way();
  EXPECT_FALSE(profile.flat());
  const double resolution_per_m = 1 / facts_of(session_).travel_m();
  EXPECT_NEAR(profile.at[profile.strongest()], 1 / kPeriod_m, resolution_per_m);
  EXPECT_GT(profile.share, 0);
}

TEST_F(Profiles, TwoPushesAreTwoLines) {
  IndependentCart cart;
  cart.push = [](double, double y, double) {
    return 0.3 * std::sin(2 * M_PI * y / 0.021 + 1) + 0.2 * std::sin(2 * M_PI * y / 0.009);
  };
  look_at(cart);
  const Profile profile = over_way();
  const std::vector<std::size_t> lines = profile.lines(2);
  ASSERT_EQ(lines.size(), 2u);
  const double resolution_per_m = 1 / facts_of(session_).travel_m();
  EXPECT_NEAR(profile.at[lines[0]], 1 / 0.021, resolution_per_m);
  EXPECT_NEAR(profile.at[lines[1]], 1 / 0.009, resolution_per_m);
}

TEST_F(Profiles, APushThatRepeatsInTimeStandsAtItsFrequency) {
  IndependentCart cart;
  cart.push = [](double t, double, double) { return 0.5 * std::sin(2 * M_PI * 23 * t); };
  look_at(cart);
  const Profile profile = over_frequency();
  EXPECT_FALSE(profile.flat());
  EXPECT_NEAR(profile.at[profile.strongest()], 23, 0.25) << "recordings of 4 s";
}

TEST_F(Profiles, AVoltageThatArrivesLateStandsAtTheFirstLags) {
  IndependentCart cart;
  cart.delay_ticks = 3;
  look_at(cart);
  const Profile profile = over_lag();
  EXPECT_FALSE(profile.flat());
  EXPECT_LE(profile.at[profile.strongest()], 4 * session_.rig.period_s());
  EXPECT_LT(profile.value[profile.strongest()], 0)
      << "a change has not yet pushed as the model thinks it has";
}

/// Errors of eight recordings of 5 s: white ones, what a filter of one pole (time constant 10 ms) makes of
/// them, or that with a line in it.
class FrequencyProfile : public testing::Test {
 protected:
  FrequencyProfile() {
    for (Recording& r : session_.recordings) r.t_s.resize(5000);
    rows_ = 8 * (5000 - settling_rows(session_.rig));
  }

  std::vector<double> white() {
    std::vector<double> errors(rows_);
    for (double& e : errors) e = normal_(random_);
    return errors;
  }
  std::vector<double> coloured() {
    std::vector<double> errors = white();
    double slow = 0;
    for (double& e : errors) slow = 0.9 * slow + e, e = 2 * e + slow;
    return errors;
  }
  std::vector<double> coloured_with_line(double frequency_hz) {
    std::vector<double> errors = coloured();
    for (std::size_t k = 0; k < rows_; ++k) {
      errors[k] += 0.8 * std::sin(2 * M_PI * frequency_hz * 1e-3 * static_cast<double>(k));
    }
    return errors;
  }
  Profile profile(const std::vector<double>& errors, const std::vector<double>& alike) {
    Fit fit;
    fit.error_m = errors;
    return frequency_profile(session_, fit, alike);
  }

 private:
  Session session_{{}, std::vector<Recording>(8)};
  std::size_t rows_ = 0;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

TEST_F(FrequencyProfile, AColourThatAnyCartLikeTheModelHasIsNoLine) {
  EXPECT_TRUE(profile(white(), white()).flat());
  EXPECT_FALSE(profile(coloured(), white()).flat());
  EXPECT_TRUE(profile(coloured(), coloured()).flat());
}

TEST_F(FrequencyProfile, ALineStandsAboveThatColour) {
  const Profile found = profile(coloured_with_line(12), coloured());
  EXPECT_FALSE(found.flat());
  EXPECT_NEAR(found.at[found.strongest()], 12, 0.2);
}

}  // namespace
}  // namespace cartwright
