// The diagnosis on machines that nobody here built. The recordings are no part of the repository:
// host/session/maps says where each comes from.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "common/config/model_toml.hpp"
#include "host/diagnose/diagnosis.hpp"
#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/identify/identify.hpp"
#include "host/session/even_rows.hpp"
#include "host/session/files.hpp"
#include "host/session/import.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using P = Parameter;

class Rigs : public testing::Test {
 protected:
  /// The session made of `files` of a rig through a map, the rows of each from one time to another.
  std::optional<Session> session(const std::string& rig, const std::string& map_name,
                                 const std::vector<std::string>& files, double from_s = -1e9,
                                 double to_s = 1e9) {
    const char* given = std::getenv("CARTWRIGHT_RECORDINGS");
    const fs::path folder = fs::path(given != nullptr ? given : CARTWRIGHT_RECORDINGS_DEFAULT) / rig;
    std::vector<fs::path> paths;
    for (const std::string& file : files) {
      paths.push_back(folder / file);
      if (!fs::exists(paths.back())) return std::nullopt;
    }
    const auto map = read_import_map(fs::path(CARTWRIGHT_SOURCE) / "host/session/maps" / map_name);
    EXPECT_TRUE(map) << map.error().message;
    auto all = import_session(paths, *map);
    EXPECT_TRUE(all) << all.error().message;
    for (Recording& r : all->recordings) {
      Recording part;
      part.file = r.file;
      for (std::size_t k = 0; k < r.size(); ++k) {
        if (r.t_s[k] < from_s || r.t_s[k] > to_s) continue;
        part.t_s.push_back(r.t_s[k]);
        part.y_m.push_back(r.y_m[k]);
        part.u_V.push_back(r.u_V[k]);
      }
      r = std::move(part);
    }
    return *all;
  }

  static Model identified(const Session& session, std::initializer_list<Term> terms) {
    return identify(session, *TermSet::create(terms))->model;
  }

  static const Effect* effect(const Diagnosis& d, Term term) {
    for (const Effect& one : d.effects) {
      if (one.term == term) return &one;
    }
    return nullptr;
  }
};

/// A servo with a pendulum, whose friction grows with its load: neither has a name in the vocabulary.
TEST_F(Rigs, LoadDependentFrictionAndGravityGetNoConfidentName) {
  const auto data =
      session("bam_xl330", "bam_xl330.toml",
              {"2026-01-15_10h28m10.json", "2026-01-15_10h29m14.json", "2026-01-15_10h29m47.json"});
  if (!data) GTEST_SKIP() << "no bam_xl330 recordings; set CARTWRIGHT_RECORDINGS";
  const Diagnosis d = diagnose(*data, identified(*data, {Term::viscous_friction, Term::coulomb_friction}));
  EXPECT_TRUE(d.verdict == Verdict::unexplained || d.unexplained.has_value()) << name(d.verdict);
  for (const Effect& one : d.effects) EXPECT_LT(one.confidence, 0.9) << info(one.term).name;
}

/// A mounting head that presses on a spring-like surface: an impact.
TEST_F(Rigs, AnImpactGetsNoConfidentName) {
  const auto data = session("pick_place", "pick_place.toml", {"headdata_1v6.mat"}, 0, 3);
  if (!data) GTEST_SKIP() << "no pick_place recordings; set CARTWRIGHT_RECORDINGS";
  const Diagnosis d = diagnose(*data, identified(*data, {Term::viscous_friction, Term::coulomb_friction}));
  EXPECT_TRUE(d.verdict == Verdict::unexplained || d.unexplained.has_value()) << name(d.verdict);
  for (const Effect& one : d.effects) EXPECT_LT(one.confidence, 0.9) << info(one.term).name;
}

/// Published: cogging of about 0.9 A, 7 periods a revolution (14 poles); one revolution stands for a metre.
TEST_F(Rigs, TheCoggingOfABrushlessMotorIsNamedWithItsPeriod) {
  const auto data = session("odrive_cogging", "odrive_spinup.toml", {"accel_tests_spinup_4_nocomp.mat"});
  if (!data) GTEST_SKIP() << "no odrive_cogging recordings; set CARTWRIGHT_RECORDINGS";
  // Four seconds whose motion is half noise do not tell the gain; the integral method has it from all of it.
  DiagnoseOptions options;
  options.held = {P::voltage_gain, P::viscous_coefficient};
  const Diagnosis d =
      diagnose(*data, identified(*data, {Term::viscous_friction, Term::coulomb_friction}), options);
  const Effect* cogging = effect(d, Term::cogging);
  ASSERT_NE(cogging, nullptr) << name(d.verdict);
  EXPECT_EQ(d.effects.front().term, Term::cogging);
  EXPECT_NEAR(1 / d.model[P::cogging_period], 7, 0.05);
  EXPECT_NEAR(d.model[P::cogging_amplitude] / d.model[P::voltage_gain], 0.9, 0.2);
}

/// The same motor turned slowly by a servo: the current only balances what cogs and rubs, no force predicts
/// more than that the speed stays, and the periods are read from the current. Published: 7, 14 and 28 a
/// revolution.
TEST_F(Rigs, TheCurrentOfAServoThatHoldsItsSpeedTellsAllThreePeriods) {
  const auto data =
      session("odrive_cogging", "odrive_cogging.toml", {"slow2_nocomp_0.mat", "slow2_nocomp_1.mat"});
  if (!data) GTEST_SKIP() << "no odrive_cogging recordings; set CARTWRIGHT_RECORDINGS";
  const Diagnosis d = diagnose(*data, identified(*data, {Term::viscous_friction, Term::coulomb_friction}));
  EXPECT_EQ(name(d.verdict), "missing_physics");
  ASSERT_EQ(d.effects.size(), 1U);
  EXPECT_EQ(d.effects.front().term, Term::cogging);
  std::vector<double> per_revolution;
  for (const PeriodicTerm& wave : kCoggingWaves) per_revolution.push_back(1 / d.model[wave.period]);
  std::sort(per_revolution.begin(), per_revolution.end());
  EXPECT_NEAR(per_revolution[0], 7, 0.05);
  EXPECT_NEAR(per_revolution[1], 14, 0.1);
  EXPECT_NEAR(per_revolution[2], 28, 0.1);
  ASSERT_TRUE(d.drive.has_value());
  EXPECT_NEAR(d.drive->lines.front().height_V.value, 0.9, 0.2);  // published
  EXPECT_LT(d.drive->unseen_left_V, 0.5 * d.drive->unseen_missing_V);
}

/// EMPS told only its inertia and viscous friction; half of one record at a fifth of its rate, to be quick.
TEST_F(Rigs, FrictionLeftOutOfEmpsIsFoundAndPredictsTheOtherRecord) {
  const auto data = session("emps", "emps.toml", {"DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"}, 0, 12.5);
  if (!data) GTEST_SKIP() << "no EMPS recordings; set CARTWRIGHT_RECORDINGS";
  constexpr double kRate_hz = 200;
  Session seen{data->rig, {even_rows(data->recordings[0], kRate_hz)}};
  Session unseen{data->rig, {even_rows(data->recordings[1], kRate_hz)}};
  seen.rig.sample_rate_hz = unseen.rig.sample_rate_hz = kRate_hz;
  const Diagnosis d = diagnose(seen, identified(seen, {Term::viscous_friction}));
  EXPECT_NE(effect(d, Term::coulomb_friction), nullptr);
  // What the publication calls an offset is, for this record, rather friction that differs between
  // directions; but more than what tells them apart stays unexplained.
  const Effect* differs = effect(d, Term::asymmetric_viscous_friction);
  ASSERT_NE(differs, nullptr);
  EXPECT_THAT(differs->equivalent, testing::Contains(Term::constant_force));
  const auto published = read_file(fs::path(CARTWRIGHT_SOURCE) / "host/session/maps/emps_published.toml");
  ASSERT_TRUE(published);
  const auto model = model_from_toml(*published, "emps_published.toml");
  ASSERT_TRUE(model);
  EXPECT_LT(window_rmse_m(d.model, unseen, 2), window_rmse_m(*model, unseen, 2));
  const Recording& whole = unseen.recordings[0];
  EXPECT_LT(open_loop_error(replay_open_loop(d.model, whole), whole).rms_m(),
            open_loop_error(replay_open_loop(*model, whole), whole).rms_m());
}

}  // namespace
}  // namespace cartwright
