// The EMPS benchmark (Janot, Gautier, Brunot 2019), measured on a machine nobody here built.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "host/evaluate/evaluate.hpp"
#include "host/identify/identify.hpp"
#include "host/identify/simulation_fit.hpp"
#include "host/session/import.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;

constexpr double kDriveGain_N_per_V = 35.15065;

class Emps : public testing::Test {
 protected:
  void SetUp() override {
    const char* given = std::getenv("CARTWRIGHT_RECORDINGS");
    folder_ = fs::path(given != nullptr ? given : CARTWRIGHT_RECORDINGS_DEFAULT) / "emps";
    if (!fs::exists(folder_ / "DATA_EMPS.mat")) {
      GTEST_SKIP() << "no EMPS recordings in " << folder_ << "; set CARTWRIGHT_RECORDINGS";
    }
  }

  Session imported(std::vector<std::string> names) {
    const auto map = read_import_map(fs::path(CARTWRIGHT_SOURCE) / "host/session/maps/emps.toml");
    EXPECT_TRUE(map) << map.error().message;
    std::vector<fs::path> files;
    for (const std::string& name : names) files.push_back(folder_ / name);
    const auto session = import_session(files, *map);
    EXPECT_TRUE(session) << session.error().message;
    return *session;
  }

  Identification identified() {
    const auto terms =
        TermSet::create({Term::viscous_friction, Term::coulomb_friction, Term::constant_force});
    IdentifyOptions options;
    options.force_scale = ForceScale{.drive_N_per_V = kDriveGain_N_per_V, .mass_kg = {}};
    return *identify(imported({"DATA_EMPS.mat"}), *terms, options);
  }

  fs::path folder_;
};

TEST_F(Emps, IdentificationAgreesWithThePublishedValues) {
  const Identification result = identified();
  ASSERT_EQ(result.forces.size(), 4u);
  const auto force = [&result](std::size_t i) { return result.forces[i].estimate.value; };
  EXPECT_NEAR(force(0), 95.109, 0.01 * 95.109);
  EXPECT_NEAR(force(1), 203.50, 0.01 * 203.50);
  EXPECT_NEAR(force(2), 20.394, 0.01 * 20.394);
  // Published on the side of friction: F = M a + Fv v + Fc sgn v + offset.
  EXPECT_NEAR(-force(3), -3.165, 0.05 * 3.165);
}

TEST_F(Emps, PredictsTheRecordItWasNotFittedTo) {
  const Model model = identified().model;
  const Session session = imported({"DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"});
  const Prediction seen = predict(model, session.rig, session.recordings[0]);
  const Prediction unseen = predict(model, session.rig, session.recordings[1]);
  EXPECT_EQ(seen.closed_loop.rows, 0u);
  // Published parameters give 8.4 mm over the whole test record; two-sided, because much better would be as
  // wrong.
  EXPECT_GT(unseen.open_loop.rms_m(), 3e-3);
  EXPECT_LT(unseen.open_loop.rms_m(), 10e-3);
  // Windows with fitted start states; with states read off the data they are 0.60 and 0.81 mm.
  EXPECT_GT(seen.window.rms_m(), 0.05e-3);
  EXPECT_LT(seen.window.rms_m(), 0.60e-3);
  EXPECT_GT(unseen.window.rms_m(), 0.05e-3);
  EXPECT_LT(unseen.window.rms_m(), 0.81e-3);
}

TEST_F(Emps, SimulationOfTheWholeRecordCarriesOverToTheTestRecord) {
  const Model identified_model = identified().model;
  const auto fit = fit_by_simulation(imported({"DATA_EMPS.mat"}), identified_model);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_LT(fit->after_m, 0.7 * fit->before_m);
  const Session test = imported({"DATA_EMPS_PULSES.mat"});
  const auto score_m = [&test](const Model& model) {
    return open_loop_error(replay_open_loop(model, test.recordings[0]), test.recordings[0]).rms_m();
  };
  EXPECT_LT(score_m(fit->model), score_m(identified_model));
}

}  // namespace
}  // namespace cartwright
