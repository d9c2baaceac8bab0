#include "tests/blind/outcome.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>

#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/session/files.hpp"
#include "tests/blind/baselines/baselines.hpp"
#include "tests/blind/battery.hpp"

namespace cartwright::blind {
namespace {

using P = Parameter;

Model believed(const Concealed& c) {
  Model model(c.nominal_gain_m_per_s2_V);
  model.set(P::viscous_coefficient, c.nominal_viscous_per_s);
  if (c.nominal_has_coulomb) model.set(P::coulomb_level, c.nominal_coulomb_m_per_s2);
  return model;
}

/// The first recordings of the battery.
Session recorded(const Concealed& c, const Case& asked) {
  Session session = battery(c.physics, asked.seed, asked.instruments.sample_rate_hz);
  session.recordings.resize(std::min(asked.recordings, session.recordings.size()));
  return session;
}

/// Processor time of this thread: other programs on the machine do not count.
double processor_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Of the excess error that the refitted nominal model has on a recording nobody saw, how much the diagnosed
/// model removes. The floor is what the exactly right model leaves on a cart that hides nothing, same noise.
double unseen_excess_removed(const Concealed& c, const Diagnosis& d, const Case& asked) {
  const std::uint64_t seed = asked.seed + 1000003;  // noise of its own
  const Session unseen = unseen_track(c.physics, seed, asked.instruments.sample_rate_hz);
  const CartPhysics& p = c.physics;
  CartPhysics plain;
  plain.gain_m_per_s2_V = p.gain_m_per_s2_V;
  plain.viscous_per_s = p.viscous_per_s;
  plain.coulomb_m_per_s2 = p.coulomb_m_per_s2;
  plain.disturbance_m_per_s2 = p.disturbance_m_per_s2;
  plain.disturbance_time_s = p.disturbance_time_s;
  plain.count_m = p.count_m;
  plain.reading_noise_m = p.reading_noise_m;
  Model exact(plain.gain_m_per_s2_V);
  exact.set(P::viscous_coefficient, plain.viscous_per_s).set(P::coulomb_level, plain.coulomb_m_per_s2);
  const auto square = [](double x) { return x * x; };
  const double floor =
      square(window_rmse_m(exact, unseen_track(plain, seed, asked.instruments.sample_rate_hz), 1));
  const double before = square(window_rmse_m(d.refitted, unseen, 1)) - floor;
  const double after = square(window_rmse_m(d.model, unseen, 1)) - floor;
  return before > 0 ? 1 - after / before : 1;
}

}  // namespace

bool Outcome::first_right() const {
  return !named.empty() && named.front().right;
}

bool Outcome::all_named() const {
  return std::all_of(expected.begin(), expected.end(), [this](const std::string& name) {
    return std::any_of(named.begin(), named.end(), [&](const NamedEffect& n) { return n.name == name; });
  });
}

bool Outcome::false_name() const {
  return std::any_of(named.begin(), named.end(), [](const NamedEffect& n) { return !n.right; });
}

bool Outcome::answered() const {
  if (asked.effects.empty()) return verdict == Verdict::no_mismatch;
  if (values_off()) return verdict == Verdict::parameters_only;
  if (outside()) return verdict == Verdict::unexplained;
  return expected.size() > 1 ? all_named() : first_right();
}

double Outcome::excess_over_floor() const {
  const double ratio = window_error_m / noise_floor_m;
  return std::sqrt(std::max(ratio * ratio - 1, 0.0));
}

Outcome ask(const Case& asked, Ask whom) {
  const Concealed hidden = draw(asked.effects, asked.size, asked.seed, asked.instruments);
  const Session session = recorded(hidden, asked);
  const Model nominal = believed(hidden);
  Outcome out;
  out.asked = asked;
  out.expected = hidden.expected;
  DiagnoseOptions options;
  options.threads = 1;
  const double began_s = processor_time_s();
  const Diagnosis d = diagnose(session, nominal, options);
  out.time_s = processor_time_s() - began_s;
  out.verdict = d.verdict;
  out.window_error_m = d.used.refitted;
  out.noise_floor_m = d.noise_floor_m;
  for (const Effect& effect : d.effects) {
    const std::string name(info(effect.term).name);
    const bool right = std::find(out.expected.begin(), out.expected.end(), name) != out.expected.end();
    out.named.push_back({name, effect.confidence, right, effect.evidence});
    for (const auto& [id, e] : effect.parameters) {
      const auto truth = hidden.truth.find(dotted_name(id));
      if (truth == hidden.truth.end() || truth->second == 0) continue;
      out.parameters.push_back({dotted_name(id), std::abs(e.value / truth->second - 1),
                                e.low <= truth->second && truth->second <= e.high});
    }
  }
  const Estimate& gain = d.parameters.front().refitted;
  out.gain_error = std::abs(gain.value / hidden.physics.gain_m_per_s2_V - 1);
  out.gain_covered =
      gain.low <= hidden.physics.gain_m_per_s2_V && hidden.physics.gain_m_per_s2_V <= gain.high;
  const bool of_one_moment = hidden.physics.push_recording >= 0 || hidden.physics.lost_rate_per_s > 0;
  out.unseen_excess_removed =
      of_one_moment || d.effects.empty() ? std::nan("") : unseen_excess_removed(hidden, d, asked);
  if (whom == Ask::diagnosis_and_baselines) {
    const double before_s = processor_time_s();
    out.baselines = ask_baselines(session, nominal, d);
    out.baselines_time_s = processor_time_s() - before_s;
  }
  return out;
}

Question question_of(const Case& asked) {
  const Concealed hidden = draw(asked.effects, asked.size, asked.seed, asked.instruments);
  return {recorded(hidden, asked), believed(hidden)};
}

Result<void> write_case(const Case& asked, const std::filesystem::path& directory) {
  const Question question = question_of(asked);
  if (const auto written = write_session(question.session, directory); !written) return written;
  return write_model(question.nominal, directory / "nominal.toml");
}

}  // namespace cartwright::blind
