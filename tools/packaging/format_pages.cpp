#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "common/model/vocabulary.hpp"
#include "common/wire/register_map.hpp"
#include "tools/packaging/markdown.hpp"
#include "tools/packaging/pages.hpp"
#include "tools/packaging/roff.hpp"

namespace cartwright::packaging {
namespace {

std::string range(const ParameterInfo& parameter) {
  std::string text;
  constexpr double kNextToZero = 1e-9;
  if (parameter.lower > 0 && parameter.lower < kNextToZero) {
    text = "greater than 0";
  } else if (std::isfinite(parameter.lower) && std::isfinite(parameter.upper)) {
    text = fmt::format("{} to {}", parameter.lower, parameter.upper);
  } else if (std::isfinite(parameter.lower)) {
    text = fmt::format("at least {}", parameter.lower);
  }
  if (parameter.default_value) {
    text += fmt::format("{}{} when left out", text.empty() ? "" : "; ", *parameter.default_value);
  }
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

std::string model_page() {
  Page page("cartwright-model", 5, "model file of a cart");
  const ParameterInfo& gain = info(Parameter::voltage_gain);
  page.section("DESCRIPTION")
      .paragraph("TOML. A model is a voltage gain and the terms whose tables are present:")
      .verbatim(fmt::format("[model]\n{} = 1.9\n\n[model.viscous_friction]\ncoefficient_per_s = 5.0\n\n"
                            "[model.coulomb_friction]\nlevel_m_per_s2 = 0.5",
                            gain.key))
      .paragraph(
          "d2y/dt2 = beta u - sum(opposing terms) + sum(pushes), with position y in m, voltage u in V and "
          "beta the voltage gain. Every term is an acceleration: force divided by the moving mass. "
          "Friction, damping, drag and spring oppose; constant force, cogging and disturbance push.")
      .paragraph(
          "From command to force the order is: dead zone, saturation, gain asymmetry, delay, lag, current "
          "limit. Friction holds the cart exactly still up to its level.")
      .paragraph(
          "A file that cartwright identify wrote has a table [intervals] as well: a line for each number "
          "with its 95 % interval, which cartwright design reads. It may be left out:")
      .verbatim("[intervals]\n\"viscous_friction.coefficient_per_s\" = [4.9, 5.1]");
  page.section("TERMS");
  for (const TermInfo& term : terms()) {
    page.subsection(fmt::format("[model.{}]", term.name)).paragraph(term.meaning);
    if (term.id == Term::external_disturbance) {
      page.item("recording", "file name of the recording it acts in, as in session.toml");
    }
    for (const ParameterInfo& parameter : parameters_of(term.id)) {
      page.item(parameter.key, std::string(parameter.meaning) + range(parameter));
    }
  }
  page.see_also("cartwright(1), cartwright-session(5)");
  return page.text();
}

std::string registers_page(const std::string& how_to) {
  Page page("cartwright-registers", 5, "Modbus register map of cartwrightd");
  page.section("DESCRIPTION")
      .paragraph(fmt::format(
          "Map version {}, Modbus TCP, port {} by default. cartwrightd --registers prints this map "
          "as Markdown. A refused write gets a Modbus exception and changes nothing.",
          wire::kMapVersion, wire::kDefaultPort));
  add_markdown(page, how_to, {"How to talk to the controller"});
  add_markdown(page, wire::register_map_markdown());
  page.see_also("cartwrightd(8), cartwright(1)");
  return page.text();
}

std::string session_page(const std::string& formats) {
  Page page("cartwright-session", 5, "a directory of recordings of a cart");
  add_markdown(page, formats, {"Session", "Control laws", "CSV", "Import map"});
  page.see_also("cartwright(1), cartwright-model(5)");
  return page.text();
}

}  // namespace cartwright::packaging
