#include "host/reproduce/least_kd.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "host/reproduce/simulated_step.hpp"
#include "host/reproduce/step_measures.hpp"

namespace cartwright::reproduce {
namespace {

constexpr double kKp_V_per_m = 100, kSettled_s = 0.5;
constexpr double kGreatestKd = 12, kStepKd = 0.02;
constexpr double kSeen_s = 1.5;  ///< long enough to see an oscillation return to the band's edge

/// The two ways to close the loop.
enum class Loop { ideal, real };

struct Response {
  std::vector<double> y_m, u_V;
};

Response respond(const Model& model, double kd, Loop loop) {
  const GainPair gains{kKp_V_per_m, kd};
  if (loop == Loop::ideal) {
    IdealResponse r = ideal_response(model, gains, kSeen_s);
    return {std::move(r.y_m), std::move(r.u_V)};
  }
  StepSetup setup;
  setup.gains = gains;
  setup.duration_s = kSeen_s;
  const Session session = simulated_step(model, setup);
  const Recording& r = session.recordings.front();
  const auto step = static_cast<std::ptrdiff_t>(step_row(r));
  return {{r.y_m.begin() + step, r.y_m.end()}, {r.u_V.begin() + step, r.u_V.end()}};
}

double settling_s(const Model& model, double kd, Loop loop) {
  return measure_step(respond(model, kd, loop).y_m, 1e-3, kStep_m).settling_s;
}

double mean_square_V2(std::span<const double> u_V, double length_s) {
  double sum = 0;
  const auto count = static_cast<std::size_t>(std::lround(length_s * 1e3));
  for (const double u : u_V.first(count)) sum += u * u;
  return sum / static_cast<double>(count);
}

/// Settling time over Kd, and the stretches of Kd that settle in time, their edges refined by halving.
struct Scan {
  std::vector<double> kd, settling;
  std::vector<std::pair<double, double>> in_time;

  Scan(const Model& model, Loop loop) {
    const auto count = static_cast<std::size_t>(std::lround(kGreatestKd / kStepKd));
    for (std::size_t i = 0; i <= count; ++i) {
      kd.push_back(static_cast<double>(i) * kStepKd);
      settling.push_back(settling_s(model, kd.back(), loop));
      const bool good = settling[i] <= kSettled_s, before = i > 0 && settling[i - 1] <= kSettled_s;
      if (good && !before) in_time.push_back({i == 0 ? 0 : edge(model, loop, kd[i - 1], kd[i]), kGreatestKd});
      if (!good && before) in_time.back().second = edge(model, loop, kd[i - 1], kd[i]);
    }
  }

  static double edge(const Model& model, Loop loop, double low, double high) {
    const bool good_at_low = settling_s(model, low, loop) <= kSettled_s;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      ((settling_s(model, middle, loop) <= kSettled_s) == good_at_low ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  double least() const {
    return in_time.empty() ? std::numeric_limits<double>::infinity() : in_time[0].first;
  }

  std::string text() const {
    std::string out;
    for (const auto& [from, to] : in_time) {
      out += out.empty() ? "" : " and ";
      out += to >= kGreatestKd ? fmt::format("{:.2f} and above", from)
                               : fmt::format("{:.2f} to {:.2f}", from, to);
    }
    return out.empty() ? "none" : out;
  }
};

report::Plot settling_plot(const std::string& name, const Scan& ideal, const Scan& real) {
  report::Plot plot;
  plot.title = name + ": settling time to 1 % over Kd, Kp = 100 V/m";
  plot.x = {"Kd", "V s/m"};
  plot.y = {.label = "settling time", .unit = "s", .least = 0, .greatest = 1.2};
  plot.add(
      {.name = "Eq. (62), ideal law", .x = ideal.kd, .y = ideal.settling, .colour = report::Colour::model});
  plot.add({.name = "sampled and limited",
            .x = real.kd,
            .y = real.settling,
            .colour = report::Colour::other_model,
            .dashed = true});
  plot.guides.push_back({report::Guide::Along::y, kSettled_s, "0.5 s"});
  return plot;
}

}  // namespace

Result<Section> least_derivative_gain(const ReproduceOptions& options) {
  struct Case {
    const char* name;
    Model model;
    double published_kd;
    const char* published_V2;
  };
  const Case cases[] = {{"Lm3", kPublishedLinear[2].model(), 7.35, "3.0 V^2"},
                        {"NLm3", kPublishedNonlinear[2].model(), 3.55, "2.0 V^2"}};
  Section section{"Section 4.4: least Kd for settling to 1 % within 0.5 s, Kp = 100", {}};
  double done = 0, least[2] = {0, 0};
  for (const Case& one : cases) {
    const Scan ideal(one.model, Loop::ideal);
    options.progress(done += 0.25);
    const Scan real(one.model, Loop::real);
    options.progress(done += 0.25);
    least[&one - cases] = ideal.least();
    section.items.push_back({fmt::format("{}: Kd that settle in time, Eq. (62)", one.name),
                             fmt::format("least {:.2f}", one.published_kd),
                             fmt::format("least {:.2f}; set: {}", ideal.least(), ideal.text()),
                             fmt::format("at the published Kd the response settles in {:.3f} s",
                                         settling_s(one.model, one.published_kd, Loop::ideal))});
    section.items.push_back(
        {fmt::format("{}: the same, loop sampled and limited", one.name), "",
         fmt::format("least {:.2f}; set: {}", real.least(), real.text()),
         "the derivative's kick, the 12 V limit and the filtered derivative of the real loop"});
    const Response at_least = respond(one.model, ideal.least(), Loop::ideal);
    const Response published = respond(one.model, one.published_kd, Loop::ideal);
    const Response limited = respond(one.model, ideal.least(), Loop::real);
    section.items.push_back(
        {fmt::format("{}: mean squared voltage over 0.5 s, 1 s", one.name), one.published_V2,
         fmt::format("{:.2f}, {:.2f} V^2 at the least Kd; {:.2f}, {:.2f} at the published; {:.2f}, {:.2f} at "
                     "the least "
                     "Kd with the real loop",
                     mean_square_V2(at_least.u_V, 0.5), mean_square_V2(at_least.u_V, 1),
                     mean_square_V2(published.u_V, 0.5), mean_square_V2(published.u_V, 1),
                     mean_square_V2(limited.u_V, 0.5), mean_square_V2(limited.u_V, 1)),
         "the paper does not say over which time, nor for which of the laws"});
    section.plots.push_back(settling_plot(one.name, ideal, real));
  }
  section.items.push_back(
      {"ratio of the two least Kd", "7.35/3.55 = 2.07", fmt::format("{:.2f}", least[0] / least[1]),
       "the conclusion stands: the linear model asks for more derivative than is needed"});
  return section;
}

}  // namespace cartwright::reproduce
