#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "firmware/compensation_setup.hpp"
#include "firmware/session_writer.hpp"
#include "host/identify/identify.hpp"
#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;

/// The repeated track experiment, until so many seconds have been recorded.
void track(TestRig& rig, double duration_s) {
  const Programme programme = rig.one([&](Settings& s) {
    s.set(Id::experiment_kind, 3);
    s.set(Id::experiment_duration_s, duration_s);
  });
  ASSERT_TRUE(rig.status().state == wire::State::armed || rig.arm());
  ASSERT_TRUE(rig.command(wire::Command::run, programme));
  ASSERT_TRUE(rig.finish());
  ASSERT_EQ(rig.status().outcome, wire::Outcome::finished);
}

TEST(Online, AgreesWithTheOfflineResultOnABattery) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("cartwright-online-" + std::to_string(::getpid()));
  // What neither knows of: a little cogging, so that there is something to disagree about.
  Model truth = cart();
  truth.set(Parameter::cogging_amplitude, 0.05).set(Parameter::cogging_period, 0.016);
  const RigFile file;
  TestRig rig(truth, file, 150'000);
  ASSERT_TRUE(rig.start(battery(rig.rig)));
  ASSERT_TRUE(rig.finish());
  ASSERT_TRUE(write_session(rig.rig, *rig.exchange, directory));
  const auto session = read_session(directory);
  std::filesystem::remove_all(directory);
  ASSERT_TRUE(session) << session.error().message;
  const auto offline =
      identify(*session, TermSet::create({Term::viscous_friction, Term::coulomb_friction}).value());
  ASSERT_TRUE(offline) << offline.error().message;
  const OnlineEstimates& online = rig.status().identified;
  const OnlineEstimate* const found[] = {&online.gain_m_per_s2_V, &online.viscous_per_s,
                                         &online.coulomb_m_per_s2};
  for (std::size_t i = 0; i < 3; ++i) {
    const double expected = offline->estimates[i].estimate.value;
    EXPECT_NEAR(found[i]->value, expected, 0.01 * expected) << i;
    EXPECT_LT(found[i]->low, found[i]->value);
    EXPECT_LT(found[i]->high - found[i]->low, 0.1 * expected) << "and says how sure it is";
  }
}

TEST(Online, KnowsNothingBeforeTheCartHasMoved) {
  TestRig rig(cart());
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) { s.set(Id::experiment_kind, 6); })));
  ASSERT_TRUE(rig.finish());
  EXPECT_TRUE(std::isnan(rig.status().identified.gain_m_per_s2_V.value));
  EXPECT_EQ(rig.status().notice, wire::Notice::none);
}

TEST(Online, FrictionThatGrowsByHalfRaisesANoticeThatStopsNothing) {
  RigFile file;
  put_model(file.settings, cart());
  TestRig rig(cart(), file);
  track(rig, 20);
  EXPECT_EQ(rig.status().notice, wire::Notice::none);
  EXPECT_LT(rig.status().innovation_m_per_s2, 0.01);
  rig.cart.set_model(cart(1.5));
  track(rig, 60);
  EXPECT_EQ(rig.status().notice, wire::Notice::model_mismatch);
  EXPECT_EQ(rig.status().notices, 1U);
  EXPECT_NEAR(rig.status().innovation_m_per_s2, 0.25, 0.03) << "half of 0.5 m/s^2";
  EXPECT_NE(static_cast<unsigned>(rig.last_row()[column::status]) & wire::kStatusNotice, 0U);
  EXPECT_NE(notice_sentence(rig.status()).find("stopped matching the model"), std::string::npos);
  rig.cart.set_model(cart());
  track(rig, 90);
  EXPECT_EQ(rig.status().notice, wire::Notice::none) << "it goes when the cause has gone";
  EXPECT_EQ(rig.status().notices, 1U);
}

TEST(Online, WithoutAModelTheRigsOwnPastIsWhatItIsHeldAgainst) {
  TestRig rig(cart());
  track(rig, 60);
  EXPECT_EQ(rig.status().notice, wire::Notice::none);
  EXPECT_LT(rig.status().innovation_m_per_s2, 0.01);
  rig.cart.set_model(cart(1.5));
  track(rig, 20);
  EXPECT_EQ(rig.status().notice, wire::Notice::model_mismatch);
  ASSERT_TRUE(rig.command(wire::Command::restart_identification));
  EXPECT_EQ(rig.status().notice, wire::Notice::none);
  EXPECT_TRUE(std::isnan(rig.status().identified.gain_m_per_s2_V.value));
  track(rig, 40);
  EXPECT_NEAR(rig.status().identified.coulomb_m_per_s2.value, 0.75, 0.01);
  EXPECT_EQ(rig.status().notice, wire::Notice::none) << "learned anew";
}

TEST(Online, MissedTicksAreGapsAndNotData) {
  // Every tenth of a second some ticks go missing: without gaps known as gaps the numbers would be off by
  // far.
  TestRig rig(cart());
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(Id::experiment_kind, 3);
    s.set(Id::experiment_duration_s, 60);
  })));
  std::int64_t now_ns = rig.now_ns();
  for (int tick = 0; rig.controller.state() == wire::State::running; ++tick) {
    const int missed = tick % 331 == 0 ? 7 : 0;
    now_ns += (1 + missed) * TestRig::kPeriod_ns;
    rig.controller.tick({now_ns, (1 + missed) * TestRig::kPeriod_ns}, 0, static_cast<std::uint32_t>(missed));
  }
  EXPECT_NEAR(rig.status().identified.gain_m_per_s2_V.value, 1.9, 0.01 * 1.9);
  EXPECT_NEAR(rig.status().identified.coulomb_m_per_s2.value, 0.5, 0.01 * 0.5);
}

}  // namespace
}  // namespace cartwright::firmware
