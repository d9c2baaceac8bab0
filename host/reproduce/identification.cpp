#include "host/reproduce/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "host/identify/step_response.hpp"
#include "host/reproduce/simulated_step.hpp"
#include "host/reproduce/spread.hpp"

namespace cartwright::reproduce {
namespace {

/// Encoder of the cart, and noise of half a count (electrical, belt).
constexpr double kEncoder_m = 2.275e-5, kNoise_m = 0.5 * kEncoder_m;
/// Eq. (65): the paper's d, and its six intervals of 0.15 s.
constexpr double kRise_per_s = 0.5;
constexpr std::size_t kIntervals = 6;

StepOptions constant_damping() {
  StepOptions options;
  options.draws = 0;
  return options;
}

StepOptions six_intervals(std::optional<double> rise_per_s) {
  StepOptions options = constant_damping();
  options.intervals = kIntervals;
  options.constraints.least_rise_per_s = rise_per_s;
  return options;
}

Result<StepIdentification> identified(const Session& session, const StepOptions& options) {
  const auto step = find_step(session, options);
  if (!step) return tl::unexpected(step.error());
  return identify_step(*step, options);
}

Session draw_step(double kp_V_per_m, unsigned long seed) {
  StepSetup setup;
  setup.gains = {kp_V_per_m, 0};
  setup.encoder_resolution_m = kEncoder_m;
  setup.noise_m = kNoise_m;
  setup.seed = seed;
  std::mt19937_64 random(seed);
  setup.reading_phase = std::uniform_real_distribution<double>(0, 1)(random);
  return simulated_step(cart_at(kp_V_per_m), setup);
}

/// What the draws of one cart give.
struct Draws {
  Spread c, beta_constant;                                 ///< constant damping
  Spread alpha1_free, alpha2_free, gamma_free, beta_free;  ///< six free values and their law
  Spread alpha1, alpha2, gamma, beta;                      ///< six rising values and their law
  Spread residual_constant_m, residual_free_m, residual_m;
  int without_law = 0;
  StepIdentification first, first_free;
};

Result<Draws> draw_cart(double kp_V_per_m, int draws, unsigned long seed) {
  Draws out;
  for (int i = 0; i < draws; ++i) {
    const Session session = draw_step(kp_V_per_m, seed + static_cast<unsigned long>(i));
    const auto constant = identified(session, constant_damping());
    if (!constant) return tl::unexpected(constant.error());
    out.c.add(constant->model[Parameter::viscous_coefficient]);
    out.beta_constant.add(constant->model[Parameter::voltage_gain]);
    out.residual_constant_m.add(constant->mean_residual_m);
    const auto free = identified(session, six_intervals({}));
    if (free) {
      out.alpha1_free.add(free->model[Parameter::exponential_alpha1]);
      out.alpha2_free.add(free->model[Parameter::exponential_alpha2]);
      out.gamma_free.add(free->model[Parameter::exponential_gamma]);
      out.beta_free.add(free->model[Parameter::voltage_gain]);
      if (out.beta_free.count() == 1) out.first_free = *free;
      out.residual_free_m.add(free->mean_residual_m);
    }
    const auto rising = identified(session, six_intervals(kRise_per_s));
    if (!rising) {
      ++out.without_law;
      continue;
    }
    out.alpha1.add(rising->model[Parameter::exponential_alpha1]);
    out.alpha2.add(rising->model[Parameter::exponential_alpha2]);
    out.gamma.add(rising->model[Parameter::exponential_gamma]);
    out.beta.add(rising->model[Parameter::voltage_gain]);
    out.residual_m.add(rising->mean_residual_m);
    if (out.beta.count() == 1) out.first = *rising;
  }
  if (out.beta.count() == 0 || out.beta_free.count() == 0)
    return failure("no draw gave a law of damping against speed");
  return out;
}

/// The same identification without encoder, noise and sampling: half a period of delay in the loop takes
/// beta Kp Ts/2 off the damping.
std::string continuous_loop(double kp_V_per_m) {
  const IdealResponse response = ideal_response(cart_at(kp_V_per_m), {kp_V_per_m, 0}, 0.9);
  std::vector<double> t_s, e_m;
  for (std::size_t i = 0; i < response.y_m.size(); ++i) {
    t_s.push_back(static_cast<double>(i) * response.period_s);
    e_m.push_back(kStep_m - response.y_m[i]);
  }
  const ConstantFit fit = fit_constant({t_s, e_m, {}});
  return fmt::format("with a continuous loop and no encoder C {:.3f}, beta {:.4f}", fit.damping_per_s,
                     fit.stiffness / kp_V_per_m);
}

/// Greatest distance between two damping laws over the speeds of the experiment, as a share of the first.
double law_distance(const Model& a, const Model& b, double greatest_m_per_s) {
  const auto law = [](const Model& m) {
    return DampingLaw{m[Parameter::exponential_alpha1], m[Parameter::exponential_alpha2],
                      m[Parameter::exponential_gamma]};
  };
  double out = 0;
  for (double v = 0.02; v <= greatest_m_per_s; v += 0.01)
    out = std::max(out, std::abs(law(b).at(v) / law(a).at(v) - 1));
  return out;
}

report::Plot damping_over_time(const Draws& draws, double kp_V_per_m) {
  report::Plot plot;
  plot.title = fmt::format("Figs. 10, 11: damping over time, Kp = {:g} V/m", kp_V_per_m);
  plot.x = {"time after the step", "s"};
  plot.y = {"damping", "1/s"};
  const auto steps = [&plot](std::string name, const StepIdentification& one, report::Colour colour,
                             bool dashed) {
    report::Series series{
        .name = std::move(name), .mark = report::Mark::step, .colour = colour, .dashed = dashed};
    const double start_s = one.damping.front().start_s;
    for (const DampingInterval& interval : one.damping) {
      series.x.push_back(interval.start_s - start_s);
      series.y.push_back(interval.damping_per_s.value);
    }
    series.x.push_back(one.damping.back().end_s - start_s);
    series.y.push_back(series.y.back());
    plot.add(std::move(series));
  };
  steps("free", draws.first_free, report::Colour::model, false);
  steps("rising by 0.5", draws.first, report::Colour::other_model, true);
  return plot;
}

report::Plot damping_over_speed(const Draws& draws, const PublishedNonlinear& published) {
  report::Plot plot;
  plot.title = fmt::format("Fig. 15, 17: damping against speed, Kp = {:g} V/m", published.kp_V_per_m);
  plot.x = {"speed", "m/s"};
  plot.y = {"damping", "1/s"};
  report::Series points{
      .name = "six values, free", .mark = report::Mark::points, .colour = report::Colour::model};
  for (const DampingInterval& one : draws.first_free.damping) {
    points.x.push_back(one.speed_m_per_s);
    points.y.push_back(one.damping_per_s.value);
  }
  const double fastest_m_per_s = std::max(0.8, *std::max_element(points.x.begin(), points.x.end()));
  const auto line = [&](std::string name, const Model& m, report::Colour colour, bool dashed) {
    const DampingLaw law{m[Parameter::exponential_alpha1], m[Parameter::exponential_alpha2],
                         m[Parameter::exponential_gamma]};
    report::Series series{.name = std::move(name), .colour = colour, .dashed = dashed};
    for (double v = 0; v <= 1.02 * fastest_m_per_s; v += 0.01) {
      series.x.push_back(v);
      series.y.push_back(law.at(v));
    }
    plot.add(std::move(series));
  };
  line("published, and the simulated cart", published.model(), report::Colour::truth, false);
  line("identified, free", draws.first_free.model, report::Colour::model, false);
  line("identified, rising by 0.5", draws.first.model, report::Colour::other_model, true);
  plot.add(std::move(points));
  return plot;
}

/// The printed forms of Eq. (65), damping that falls, and of Eq. (66), velocity with its sign.
Result<void> add_printed_forms(Section& section, double kp_V_per_m) {
  StepSetup setup;
  setup.gains = {kp_V_per_m, 0};
  const Session session = simulated_step(cart_at(kp_V_per_m), setup);
  const auto step = find_step(session, six_intervals(kRise_per_s));
  if (!step) return tl::unexpected(step.error());
  const PiecewiseForm form({step->t_s, step->e_m, {}}, kIntervals);
  DampingConstraints rising, falling;
  rising.least_rise_per_s = kRise_per_s;
  falling.greatest_rise_per_s = -kRise_per_s;
  const auto list = [](const std::vector<double>& values) {
    std::string out;
    for (const double value : values) out += fmt::format("{}{:.2f}", out.empty() ? "" : ", ", value);
    return out;
  };
  const auto error_mm = [&](const PiecewiseFit& fit) {
    const auto fitted_m = form.predict(fit.unknowns);
    double sum = 0;
    for (std::size_t i = 0; i < fitted_m.size(); ++i) sum += std::abs(fitted_m[i] - step->e_m[i]);
    return 1e3 * sum / static_cast<double>(fitted_m.size());
  };
  const PiecewiseFit down = form.fit(falling), up = form.fit(rising);
  section.items.push_back(
      {"Eq. (65) as printed, c_i - c_(i+1) > 0.5", "damping rises (Fig. 11)",
       fmt::format("C = {}; fit off by {:.3f} mm", list(down.damping_per_s), error_mm(down)),
       "as printed it asks for damping that falls over time"});
  section.items.push_back({"Eq. (65) as it must read, c_(i+1) - c_i >= 0.5", "",
                           fmt::format("C = {}; fit off by {:.3f} mm", list(up.damping_per_s), error_mm(up)),
                           "the text, Fig. 11 and d = 0.5 ask for this"});
  std::vector<double> velocities, speeds;
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const std::size_t first = up.boundaries[i], last = std::min(up.boundaries[i + 1], step->t_s.size() - 1);
    velocities.push_back((step->y_m[last] - step->y_m[first]) / (step->t_s[last] - step->t_s[first]));
    speeds.push_back(std::accumulate(step->speed_m_per_s.begin() + static_cast<std::ptrdiff_t>(first),
                                     step->speed_m_per_s.begin() + static_cast<std::ptrdiff_t>(last), 0.0) /
                     static_cast<double>(last - first));
  }
  const auto law_text = [&](const std::vector<double>& v) {
    const auto law = fit_damping_law(v, up.damping_per_s);
    return law ? fmt::format("alpha1 {:.2f}, alpha2 {:.2f}, gamma {:.2f}", law->alpha1_per_s,
                             law->alpha2_s_per_m, law->gamma_per_s)
               : law.error().message;
  };
  section.items.push_back({"Eq. (66) as printed, mean velocity: " + list(velocities) + " m/s", "",
                           law_text(velocities), "a velocity changes sign, the damping law is of the speed"});
  section.items.push_back({"Eq. (66) with |v|, mean speed: " + list(speeds) + " m/s", "", law_text(speeds),
                           "what Eq. (67), (72) and Figs. 13, 14 use"});
  return {};
}

}  // namespace

Result<Section> identified_carts(const ReproduceOptions& options) {
  const int draws = std::max(10, options.draws / 10);
  Section section{
      fmt::format("Eq. 64, 73, 75-78: one simulated response of 0.9 s, encoder {:g} um, noise {:.1f} um; "
                  "± two standard deviations of {} draws",
                  1e6 * kEncoder_m, 1e6 * kNoise_m, draws),
      {}};
  std::vector<Draws> of_cart;
  for (std::size_t i = 0; i < kPublishedNonlinear.size(); ++i) {
    auto one = draw_cart(kPublishedNonlinear[i].kp_V_per_m, draws, options.seed);
    if (!one) return tl::unexpected(one.error());
    of_cart.push_back(*std::move(one));
    options.progress(static_cast<double>(i + 1) / static_cast<double>(kPublishedNonlinear.size()));
  }
  for (std::size_t i = 0; i < of_cart.size(); ++i) {
    const PublishedLinear& linear = kPublishedLinear[i];
    const Draws& d = of_cart[i];
    section.items.push_back(
        {fmt::format("{}, Kp = {:g}: C, beta", linear.equation, linear.kp_V_per_m),
         fmt::format("C {:.4f}, beta {:.4f}", linear.c_per_s, linear.beta_m_per_s2_V),
         fmt::format("C {} ({}), beta {} ({})", plus_minus(d.c), percent(d.c.mean(), linear.c_per_s),
                     plus_minus(d.beta_constant), percent(d.beta_constant.mean(), linear.beta_m_per_s2_V)),
         continuous_loop(linear.kp_V_per_m) +
             "; published from the measured cart, here from the non-linear model that stands for it"});
  }
  for (std::size_t i = 0; i < of_cart.size(); ++i) {
    const PublishedNonlinear& published = kPublishedNonlinear[i];
    const Draws& d = of_cart[i];
    const auto off = [&](const StepIdentification& one) {
      return fmt::format("the law is off by at most {:.0f} % from 0.02 to 0.4 m/s",
                         100 * law_distance(published.model(), one.model, 0.4));
    };
    section.items.push_back(
        {fmt::format("{}, Kp = {:g}: alpha1, alpha2, gamma, beta, six free values", published.equation,
                     published.kp_V_per_m),
         fmt::format("{:.4f}, {:.4f}, {:.4f}, {:.4f}", published.alpha1_per_s, published.alpha2_s_per_m,
                     published.gamma_per_s, published.beta_m_per_s2_V),
         fmt::format("{}, {}, {}, {} ({})", plus_minus(d.alpha1_free), plus_minus(d.alpha2_free),
                     plus_minus(d.gamma_free), plus_minus(d.beta_free),
                     percent(d.beta_free.mean(), published.beta_m_per_s2_V)),
         "the published values are the simulated cart's own: what is off is the method's, six constant "
         "values and mean speeds for a law; " +
             off(d.first_free)});
    section.items.push_back(
        {fmt::format("{}, Kp = {:g}: the same with Eq. (65), d = 0.5", published.equation,
                     published.kp_V_per_m),
         "",
         fmt::format("{}, {}, {}, {} ({})", plus_minus(d.alpha1), plus_minus(d.alpha2), plus_minus(d.gamma),
                     plus_minus(d.beta), percent(d.beta.mean(), published.beta_m_per_s2_V)),
         (published.kp_V_per_m > 60
              ? "this cart still swings fast late in the response, where Eq. (65) asks for the greatest "
                "damping; "
              : "") +
             off(d.first) + (d.without_law > 0 ? fmt::format("; {} draws gave no law", d.without_law) : "")});
    section.plots.push_back(damping_over_time(d, published.kp_V_per_m));
    section.plots.push_back(damping_over_speed(d, published));
  }
  const Draws& first = of_cart.front();
  section.items.push_back({"beta, six values, free and rising (Figs. 10, 11)", "1.9352, 1.9165 (0.9 %)",
                           fmt::format("{}, {}", plus_minus(first.beta_free), plus_minus(first.beta)),
                           fmt::format("the constraint moves beta by {:.1f} %",
                                       100 * std::abs(first.beta.mean() / first.beta_free.mean() - 1))});
  section.items.push_back(
      {"Figs. 9, 12: mean absolute error of the fit, constant, free, rising", "7.2, 3.09, 2.57 mm",
       fmt::format("{}, {}, {} mm", fmt::format("{:.3f}", 1e3 * first.residual_constant_m.mean()),
                   fmt::format("{:.3f}", 1e3 * first.residual_free_m.mean()),
                   fmt::format("{:.3f}", 1e3 * first.residual_m.mean())),
       "Eq. (11) with the measured integrals; the simulated cart has neither stiction nor backlash. A "
       "constraint can only raise the sum of squares; of the mean absolute error it need not be so"});
  if (const auto added = add_printed_forms(section, 60); !added) return tl::unexpected(added.error());
  return section;
}

}  // namespace cartwright::reproduce
