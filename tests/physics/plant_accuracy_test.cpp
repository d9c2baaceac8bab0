// What holds for every term and every combination: accuracy, determinism, finite numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/control/dual_relay.hpp"
#include "common/control/pd.hpp"
#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Numbers of a middling size for every term, on a rail of +-0.4 m; with a generator, spread by up to a
/// factor of two.
class Zoo {
 public:
  explicit Zoo(std::uint64_t seed) : random_(seed) {}

  double about(double middle) {
    return seedless_ ? middle : middle * std::exp2(std::uniform_real_distribution<double>(-1, 1)(random_));
  }
  static Zoo middling() {
    Zoo zoo(0);
    zoo.seedless_ = true;
    return zoo;
  }

  void add(Model& m, Term term) {
    switch (term) {
      case Term::viscous_friction:
        m.set(P::viscous_coefficient, about(5));
        break;
      case Term::coulomb_friction:
        m.set(P::coulomb_level, about(0.5));
        break;
      case Term::exponential_damping:
        m.set(P::exponential_alpha1, about(4))
            .set(P::exponential_alpha2, about(20))
            .set(P::exponential_gamma, about(1));
        break;
      case Term::stribeck_friction:
        m.set(P::stribeck_excess, about(0.2)).set(P::stribeck_speed, about(0.03));
        break;
      case Term::constant_force:
        m.set(P::constant_acceleration, about(0.2));
        break;
      case Term::asymmetric_viscous_friction:
        m.set(P::asymmetric_viscous_difference, about(0.3));
        break;
      case Term::position_dependent_friction:
        m.set(P::spot_peak, about(0.5)).set(P::spot_centre, about(0.05)).set(P::spot_width, about(0.02));
        break;
      case Term::cogging:
        m.set(P::cogging_amplitude, about(0.4))
            .set(P::cogging_period, about(0.02))
            .set(P::cogging_phase, about(1));
        break;
      case Term::backlash:
        m.set(P::backlash_gap, about(5e-4));
        break;
      case Term::input_dead_zone:
        m.set(P::dead_zone_half_width, about(0.2));
        break;
      case Term::voltage_saturation:
        m.set(P::saturation_limit, about(6));
        break;
      case Term::current_limit:
        m.set(P::current_limit, about(8));
        break;
      case Term::armature_lag:
        m.set(P::armature_time_constant, about(5e-3));
        break;
      case Term::transport_delay:
        m.set(P::transport_delay, about(3.3e-3));
        break;
      case Term::cable_spring:
        m.set(P::spring_stiffness, about(3)).set(P::spring_neutral, about(0.02));
        break;
      case Term::quadratic_drag:
        m.set(P::drag_coefficient, about(2));
        break;
      case Term::flexible_coupling:
        m.set(P::coupling_resonance, about(20)).set(P::coupling_damping_ratio, about(0.05));
        m.set(P::coupling_load_share, about(0.4));
        break;
      case Term::motor_heating:
        m.set(P::heating_gain_loss, about(0.15)).set(P::heating_time_constant, about(20));
        break;
      case Term::presliding_friction:
        m.set(P::presliding_stiffness, about(5e3));
        break;
      case Term::external_disturbance:
        m.set(P::disturbance_start, about(2.0017)).set(P::disturbance_duration, about(0.1));
        m.set(P::disturbance_peak, about(2));
        break;
      case Term::amplifier_gain_asymmetry:
        m.set(P::amplifier_gain_difference, about(0.15));
        break;
      case Term::encoder_eccentricity:
      case Term::encoder_missed_counts:
        m.add(term);
        break;  // not the plant's
    }
  }

  Model combination() {
    Model model(about(1.9));
    add(model, Term::viscous_friction);
    for (const TermInfo& term : terms()) {
      if (std::uniform_real_distribution<double>(0, 1)(random_) < 0.3) add(model, term.id);
    }
    return model;
  }

 private:
  std::mt19937_64 random_;
  bool seedless_ = false;
};

struct Trajectory {
  std::vector<double> commands_V, position_m;
};

template <typename Law>
Trajectory closed_loop(const Model& model, Law law, double step_s, double duration_s) {
  PlantOptions options;
  options.step_s = step_s;
  Plant plant(model, options);
  plant.reset(0);
  Trajectory run;
  for (int tick = 0; tick < duration_s * 1000; ++tick) {
    run.position_m.push_back(plant.state().position_m);
    const double reference_m = tick / 1500 % 2 == 0 ? 0.1 : -0.1;
    run.commands_V.push_back(law.update(reference_m, plant.state().position_m));
    plant.advance(run.commands_V.back(), 1e-3);
  }
  return run;
}

Trajectory pd_steps(const Model& model, double step_s = 2.5e-4, double duration_s = 10) {
  return closed_loop(model, PdController({60, 2, 50, false}, 1e-3, 12), step_s, duration_s);
}

Trajectory relay(const Model& model, double step_s = 2.5e-4, double duration_s = 10) {
  return closed_loop(model, DualRelayController({4, 1, 0}, 1e-3, 12), step_s, duration_s);
}

Trajectory replay(const Model& model, const Trajectory& run, double step_s, double start_m) {
  PlantOptions options;
  options.step_s = step_s;
  Plant plant(model, options);
  plant.reset(start_m);
  Trajectory again{run.commands_V, {}};
  for (const double command_V : run.commands_V) {
    again.position_m.push_back(plant.state().position_m);
    plant.advance(command_V, 1e-3);
  }
  return again;
}

struct Comparison {
  double worst_m = 0;
  double compared = 0;  ///< share of the ticks
};

/// The same commands computed in another way. Stick-slip and cogging make some motions diverge by
/// themselves; what a start one nanometre off has moved by more than thirty is not the integrator's to
/// repeat, and ends the comparison.
Comparison compare(const Model& model, const Trajectory& run, const Trajectory& other) {
  const Trajectory nudged = replay(model, run, 2.5e-4, 1e-9);
  Comparison result;
  const std::size_t ticks = run.position_m.size();
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    if (std::abs(nudged.position_m[tick] - run.position_m[tick]) > 30e-9) break;
    result.worst_m = std::max(result.worst_m, std::abs(other.position_m[tick] - run.position_m[tick]));
    result.compared += 1.0 / static_cast<double>(ticks);
  }
  return result;
}

/// With half the inner step.
Comparison change(const Model& model, const Trajectory& run) {
  return compare(model, run, replay(model, run, 1.25e-4, 0));
}

std::string names(const Model& model) {
  std::string list;
  for (const TermInfo& term : terms()) {
    if (model.has(term.id)) list.append(term.name).append(" ");
  }
  return list;
}

class EveryTerm : public testing::TestWithParam<Term> {};

TEST_P(EveryTerm, HalvingTheInnerStepChangesTenSecondsByLessThanAMicrometre) {
  Zoo zoo = Zoo::middling();
  Model model(1.9);
  zoo.add(model, Term::viscous_friction);
  zoo.add(model, Term::coulomb_friction);
  zoo.add(model, GetParam());
  for (const Trajectory& run : {pd_steps(model), relay(model)}) {
    const Comparison halving = change(model, run);
    EXPECT_LT(halving.worst_m, 1e-6);
    EXPECT_GT(halving.compared, 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Plant, EveryTerm, testing::ValuesIn([] {
                           std::vector<Term> all;
                           for (const TermInfo& term : terms()) all.push_back(term.id);
                           return all;
                         }()),
                         [](const auto& info_of) {
                           return std::string(cartwright::info(info_of.param).name);
                         });

/// Linear forces between two masses are solved by a series; a drag too small to matter makes them the
/// Runge-Kutta method's.
TEST(LinearTwoMasses, TheirSeriesAgreesWithTheIntegratorOfAnyForce) {
  const Model one = Model(1.9).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.4);
  std::vector<Model> models;
  for (const double share : {0.2, 0.5, 0.8}) {
    models.push_back(Model(one).set(P::coupling_resonance, 15).set(P::coupling_damping_ratio, 0.05));
    models.back().set(P::coupling_load_share, share).set(P::coupling_load_friction_share, 0.7);
    models.push_back(Model(one).set(P::backlash_gap, 4e-4).set(P::backlash_contact_resonance, 150));
    models.back().set(P::backlash_load_share, share).set(P::backlash_load_damping_share, 0.2);
  }
  double compared = 0;
  for (const Model& model : models) {
    const Model any = Model(model).set(P::drag_coefficient, 1e-9);
    for (const Trajectory& run : {pd_steps(model), relay(model)}) {
      const Comparison other = compare(model, run, replay(any, run, 6e-5, 0));
      EXPECT_LT(other.worst_m, 1e-6) << names(model);
      compared += other.compared / 12;
    }
  }
  EXPECT_GT(compared, 0.9);
}

TEST(EveryCombination, HalvingTheInnerStepChangesTenSecondsByLessThanAMicrometre) {
  double compared = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Zoo zoo(seed);
    const Model model = zoo.combination();
    for (const Trajectory& run : {pd_steps(model), relay(model)}) {
      const Comparison halving = change(model, run);
      EXPECT_LT(halving.worst_m, 1e-6) << "seed " << seed << ": " << names(model);
      compared += halving.compared / 80;
    }
  }
  EXPECT_GT(compared, 0.9);
}

TEST(EveryCombination, IsFiniteAndRepeatsExactly) {
  for (std::uint64_t seed = 100; seed < 160; ++seed) {
    const Model model = Zoo(seed).combination();
    const Trajectory once = relay(model, 1e-3, 2), again = relay(model, 1e-3, 2);
    ASSERT_EQ(once.position_m, again.position_m);
    for (const double y : once.position_m) ASSERT_TRUE(std::isfinite(y)) << names(model);
  }
}

TEST(EveryPair, IsFinite) {
  for (const TermInfo& first : terms()) {
    for (const TermInfo& second : terms()) {
      Zoo zoo = Zoo::middling();
      Model model(1.9);
      zoo.add(model, first.id);
      zoo.add(model, second.id);
      const Trajectory run = pd_steps(model, 1e-3, 0.5);
      ASSERT_TRUE(std::isfinite(run.position_m.back())) << first.name << " with " << second.name;
    }
  }
}

TEST(EveryCombination, ACopyGoesOnLikeTheOriginal) {
  for (std::uint64_t seed = 200; seed < 220; ++seed) {
    Plant plant(Zoo(seed).combination());
    plant.reset(0.01, 0.2);
    for (int tick = 0; tick < 200; ++tick) plant.advance(3 * std::sin(0.1 * tick), 1e-3);
    Plant copy = plant;
    for (int tick = 0; tick < 200; ++tick) {
      plant.advance(2 * std::cos(0.1 * tick), 1e-3);
      copy.advance(2 * std::cos(0.1 * tick), 1e-3);
      ASSERT_EQ(plant.state().position_m, copy.state().position_m);
    }
  }
}

}  // namespace
}  // namespace cartwright
