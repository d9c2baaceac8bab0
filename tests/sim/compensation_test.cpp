#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "firmware/compensation_setup.hpp"
#include "firmware/session_writer.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/control_law.hpp"
#include "host/export/ulog.hpp"
#include "host/session/session.hpp"
#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;

RigFile file_with(double mode, const Model& model) {
  RigFile file;
  file.rig.encoder_resolution_m = 1e-6;
  put_model(file.settings, model);
  file.settings.set(Id::compensation_mode, mode);
  return file;
}

/// A sine of 0.5 Hz and 0.1 m.
Programme sine(TestRig& rig, double duration_s = 8) {
  return rig.one([duration_s](Settings& s) {
    s.set(Id::experiment_kind, 3);
    s.set(Id::track_shape, 1);
    s.set(Id::track_amplitude_m, 0.1);
    s.set(Id::track_low_hz, 0.5);
    s.set(Id::experiment_duration_s, duration_s);
    s.set(Id::experiment_own_gains, 1);
    s.set(Id::experiment_kp_V_per_m, 80);
    s.set(Id::experiment_kd_V_s_per_m, 3);
  });
}

double tracking_error_m(TestRig& rig) {
  EXPECT_TRUE(rig.start(sine(rig)));
  EXPECT_TRUE(rig.finish());
  double sum = 0;
  const auto rows = rig.rows_of(0);
  for (const LogRow& row : rows) sum += std::pow(row[column::r] - row[column::truth_y], 2);
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

double value(const LogRow& row, std::string_view name) {
  for (std::size_t i = 0; i < kLogColumns; ++i) {
    if (kLogColumnNames[i] == name) return row[i];
  }
  return 1e300;
}

TEST(Compensation, OfARunCutsItsTrackingErrorByMoreThanElevenInEitherMode) {
  TestRig without(cart(), file_with(0, cart())), forward(cart(), file_with(1, cart())),
      adaptive(cart(), file_with(2, cart()));
  const double error_m = tracking_error_m(without);
  EXPECT_GT(error_m / tracking_error_m(forward), 11);
  EXPECT_GT(error_m / tracking_error_m(adaptive), 11);
}

TEST(Compensation, IsLoggedWithItsEstimatesAndOnlyWhileItActs) {
  TestRig off(cart(), file_with(0, cart())), adaptive(cart(), file_with(2, cart(0.8)));
  tracking_error_m(off);
  tracking_error_m(adaptive);
  const LogRow without = off.rows_of(0)[5000], with = adaptive.rows_of(0)[5000];
  EXPECT_EQ(without[column::d], 0);
  EXPECT_TRUE(std::isnan(value(without, "compensation_V")));
  EXPECT_TRUE(std::isnan(value(without, "estimate_f1_V")));
  EXPECT_EQ(with[column::d], value(with, "compensation_V"));
  EXPECT_GT(std::abs(with[column::d]), 0.1);
  EXPECT_NEAR(value(with, "estimate_b_V_s2_per_m"), 1 / 1.9, 0.1 / 1.9);
  EXPECT_GT(value(with, "estimate_f1_V"), 0.8 * 0.5 / 1.9) << "on its way from 80 % to the truth";
}

TEST(Compensation, SwitchesInTheMiddleOfARunWithoutABump) {
  TestRig rig(cart(), file_with(0, cart()));
  ASSERT_TRUE(rig.start(sine(rig)));
  rig.ticks(4000);
  Settings settings = rig.rig.settings;
  for (const double mode : {1.0, 2.0, 0.0}) {
    const LogRow before = rig.last_row();
    settings.set(Id::compensation_mode, mode);
    auto request = std::make_unique<Request>();
    request->command = wire::Command::set_compensation;
    request->compensation = *compensation_from(settings, rig.rig);
    rig.exchange->requests.post(*request);
    rig.loop.tick();
    EXPECT_NEAR(rig.last_row()[column::d], before[column::d], 0.02);
    EXPECT_EQ(static_cast<double>(rig.status().compensation), mode);
    rig.ticks(1000);
  }
  EXPECT_LT(std::abs(rig.last_row()[column::d]), 0.02) << "off again: what was left of it has gone";
}

TEST(Compensation, LeavesARecordingThatReplaysExactly) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("cartwright-compensated-" + std::to_string(::getpid()));
  TestRig rig(cart(), file_with(2, cart(0.7)));
  tracking_error_m(rig);
  ASSERT_TRUE(write_session(rig.rig, *rig.exchange, directory));
  const auto session = read_session(directory);
  std::filesystem::remove_all(directory);
  ASSERT_TRUE(session) << session.error().message;
  const Recording& recording = session->recordings[0];
  // The contract's law on the recorded readings, with d_V, is the recorded command to the last bit.
  ControlLaw law(session->rig, recording);
  for (std::size_t row = 0; row < recording.size(); ++row) {
    ASSERT_EQ(law.command_V(row, recording.y_m[row]), recording.u_V[row]) << row;
  }
  // And the whole loop on the true cart is the recorded movement, to within the encoder.
  const Recording again = simulate(cart(), session->rig, recording);
  double worst = 0;
  for (std::size_t row = 0; row < recording.size(); ++row)
    worst = std::max(worst, std::abs(again.y_m[row] - recording.y_m[row]));
  EXPECT_LE(worst, 1.01 * session->rig.encoder_resolution_m);
  EXPECT_TRUE(recording.other_columns.contains("estimate_f1_V"));
  const auto exported = to_ulog(session->rig, recording);
  ASSERT_TRUE(exported);
  EXPECT_NE(exported->find("double estimate_f1_V;"), std::string::npos);
}

TEST(Compensation, IsRefusedWithoutAModelAndLeftOutOfRelayTests) {
  RigFile file = file_with(1, cart());
  file.settings.set(Id::model_voltage_gain_m_per_s2_V, 0);
  const auto setup = compensation_from(file.settings, file);
  ASSERT_FALSE(setup);
  EXPECT_NE(setup.error().message.find("model_voltage_gain_m_per_s2_V"), std::string::npos);

  TestRig rig(cart(), file_with(2, cart()));
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) { s.set(Id::experiment_kind, 2); })));
  ASSERT_TRUE(rig.finish());
  for (const LogRow& row : rig.rows_of(0)) EXPECT_EQ(row[column::d], 0);
}

TEST(Compensation, APerfectModelMeetsNoLimitAndAFarOneRaisesANotice) {
  TestRig good(cart(), file_with(2, cart()));
  tracking_error_m(good);
  EXPECT_EQ(good.status().notices, 0U);
  TestRig far(cart(3), file_with(2, cart(0.5)));
  tracking_error_m(far);
  EXPECT_NE(far.status().limits_met, 0);
  EXPECT_GT(far.status().notices, 0U);
  EXPECT_EQ(far.status().outcome, wire::Outcome::finished) << "a notice stops nothing";
}

}  // namespace
}  // namespace cartwright::firmware
