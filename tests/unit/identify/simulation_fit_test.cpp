// Numbers of a model from simulating whole recordings.

#include "host/identify/simulation_fit.hpp"

#include <gmock/gmock.h>

#include "host/evaluate/replay.hpp"
#include "host/identify/identify.hpp"
#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;
using P = Parameter;

Model cart() {
  return Model(1.9)
      .set(P::viscous_coefficient, 5)
      .set(P::coulomb_level, 0.4)
      .set(P::constant_acceleration, 0.1)
      .set(P::asymmetric_viscous_difference, -0.2);
}

Model about(Model model) {
  for (const P id : {P::voltage_gain, P::viscous_coefficient, P::coulomb_level})
    model.set(id, 1.1 * model[id]);
  return model.set(P::constant_acceleration, 0).set(P::asymmetric_viscous_difference, 0);
}

SimulationFitOptions holding(std::vector<Parameter> held) {
  SimulationFitOptions options;
  options.held = std::move(held);
  return options;
}

const ParameterEstimate& of(const SimulationFit& fit, P id) {
  const auto found = std::find_if(fit.estimates.begin(), fit.estimates.end(),
                                  [id](const ParameterEstimate& one) { return one.parameter == id; });
  EXPECT_NE(found, fit.estimates.end()) << dotted_name(id);
  return *found;
}

double open_loop_m(const Model& model, const Session& session) {
  SquaredError error;
  for (const Recording& r : session.recordings) error.add(open_loop_error(replay_open_loop(model, r), r));
  return error.rms_m();
}

/// A slow sine that turns often, from rest.
SimulatedSession& add_slow(SimulatedSession& session, int count, double phase) {
  for (int i = 0; i < count; ++i) {
    session.add("slow_" + std::to_string(i) + ".csv", {80, 2}, 6, [i, phase](double t_s) {
      return 0.05 * std::sin(2 * std::numbers::pi * (0.3 + 0.1 * i) * t_s + phase) - 0.05 * std::sin(phase);
    });
  }
  return session;
}

TEST(SimulationFit, FindsTheCartFromAModelThatIsATenthOff) {
  SimulatedSession simulated(cart());
  const Session session = simulated.add_usual(3).get();
  const auto fit = fit_by_simulation(session, about(cart()));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_EQ(fit->estimates.size(), 5u);
  EXPECT_THAT(fit->not_separable, testing::IsEmpty());
  const double count_m = session.rig.encoder_resolution_m;
  EXPECT_GT(fit->before_m, 100 * count_m);
  // A start state read from 20 rounded rows is off by a part of a count, the recorded reading by another.
  EXPECT_LT(fit->after_m, count_m);
  for (const P id : {P::voltage_gain, P::viscous_coefficient, P::coulomb_level, P::constant_acceleration,
                     P::asymmetric_viscous_difference}) {
    const Estimate& found = of(*fit, id).estimate;
    EXPECT_NEAR(found.value, cart()[id], 0.005 * std::abs(cart()[id])) << dotted_name(id);
    ASSERT_TRUE(found.has_interval());
    EXPECT_LT(found.low, cart()[id]) << dotted_name(id);
    EXPECT_GT(found.high, cart()[id]) << dotted_name(id);
  }
}

TEST(SimulationFit, FollowsTheSameWaysUnderPulsesBetterThanShortWindowsWhereASlowPushIsMissing) {
  // A tether pulls, and the models fitted know none; over short windows its pull is a constant like another.
  const Model truth = cart().set(P::spring_stiffness, 2).set(P::spring_neutral, 0);
  SimulatedSession simulated(truth);
  const Session session = add_slow(simulated, 4, 0).get();
  Session pulsed = session;
  for (Recording& r : pulsed.recordings) {
    for (const double t_s : r.t_s) r.d_V.push_back(std::fmod(t_s, 1.0) < 0.5 ? 0.0 : 1.0);
    r = simulate(truth, pulsed.rig, r);
  }
  const auto terms = TermSet::create({Term::viscous_friction, Term::coulomb_friction, Term::constant_force});
  const auto by_windows = identify(session, *terms);
  ASSERT_TRUE(by_windows) << by_windows.error().message;
  const auto fit = fit_by_simulation(session, by_windows->model);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->before_m, open_loop_m(by_windows->model, session), 1e-12);
  EXPECT_NEAR(fit->after_m, open_loop_m(fit->model, session), 1e-12);
  EXPECT_LT(fit->after_m, fit->before_m);
  EXPECT_LT(open_loop_m(fit->model, pulsed), open_loop_m(by_windows->model, pulsed));
}

TEST(SimulationFit, KeepsWhatIsHeldAndWhatActsFast) {
  const Model truth = cart().set(P::transport_delay, 0.004);
  SimulatedSession simulated(truth);
  const Session session = simulated.add_usual(1).get();
  const auto fit = fit_by_simulation(session, about(truth), holding({P::voltage_gain}));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_EQ(fit->model[P::voltage_gain], 1.1 * truth[P::voltage_gain]);
  EXPECT_EQ(fit->model[P::transport_delay], 0.004);
  EXPECT_THAT(fit->held, testing::UnorderedElementsAre(P::voltage_gain, P::transport_delay));
  EXPECT_EQ(fit->estimates.size(), 4u);
}

TEST(SimulationFit, LeavesIntervalsOpenForFewRecordings) {
  SimulatedSession simulated(cart());
  const Session session = simulated.add_usual(1).get();
  const auto fit = fit_by_simulation(session, about(cart()));
  ASSERT_TRUE(fit) << fit.error().message;
  for (const ParameterEstimate& one : fit->estimates) EXPECT_FALSE(one.estimate.has_interval());
}

TEST(SimulationFit, SaysWhatTheRecordingsDoNotTell) {
  SimulatedSession simulated(cart().set(P::asymmetric_viscous_difference, 0).set(P::viscous_coefficient, 0));
  const Session session = simulated.add_usual(1).get();
  // A difference between directions of no viscous friction is no number at all.
  const auto fit = fit_by_simulation(session,
                                     Model(1.9)
                                         .set(P::viscous_coefficient, 0)
                                         .set(P::coulomb_level, 0.4)
                                         .set(P::constant_acceleration, 0.1)
                                         .set(P::asymmetric_viscous_difference, 0.1),
                                     holding({P::viscous_coefficient}));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_THAT(fit->not_separable, testing::ElementsAre(P::asymmetric_viscous_difference));
}

TEST(SimulationFit, SecondHalvesGoOnWithTheRecordingsClock) {
  // A motor that loses a fifth within seconds: were it cold again in the middle, second halves would be off.
  const Model truth = cart().set(P::heating_gain_loss, 0.2).set(P::heating_time_constant, 2);
  SimulatedSession simulated(truth);
  const Session session = add_slow(simulated, 4, 0).get();
  const auto fit = fit_by_simulation(session, truth);
  ASSERT_TRUE(fit && fit->held_out_m);
  EXPECT_LT(*fit->held_out_m, 10 * session.rig.encoder_resolution_m);
  Model cold_again = truth;
  cold_again.remove(Term::motor_heating);
  const auto without = fit_by_simulation(session, cold_again);
  ASSERT_TRUE(without && without->held_out_m);
  EXPECT_GT(*without->held_out_m, 3 * *fit->held_out_m);
}

TEST(SimulationFit, RefusesWhatItCannotUse) {
  SimulatedSession simulated(cart());
  const Session session = simulated.add_usual(1).get();
  const auto refusal = [](const Session& from, const Model& model, const SimulationFitOptions& options = {}) {
    const auto fit = fit_by_simulation(from, model, options);
    return fit ? std::string("accepted") : fit.error().message;
  };
  EXPECT_THAT(refusal(session, Model(1.9), holding({P::voltage_gain})), HasSubstr("is held"));
  EXPECT_THAT(refusal(session, cart().set(P::spring_stiffness, -1e6).set(P::spring_neutral, 0.01)),
              HasSubstr("runs away"));
  Session brief = session;
  for (Recording& r : brief.recordings) {
    for (auto* column : {&r.t_s, &r.y_m, &r.u_V, &r.r_m}) column->resize(50);
  }
  EXPECT_THAT(refusal(brief, cart()), HasSubstr("100 rows"));
  Session still = session;
  for (Recording& r : still.recordings) {
    std::fill(r.y_m.begin(), r.y_m.end(), 0.0);
    std::fill(r.u_V.begin(), r.u_V.end(), 0.0);
  }
  EXPECT_THAT(refusal(still, cart()), HasSubstr("nothing moves"));
}

}  // namespace
}  // namespace cartwright
