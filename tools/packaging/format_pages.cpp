#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "common/model/vocabulary.hpp"
#include "common/wire/register_map.hpp"
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

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream rest(row.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) {
    const auto first = cell.find_first_not_of(" `");
    const auto last = cell.find_last_not_of(" `");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// Markdown as this project writes it: headings, paragraphs and tables. A table's row becomes an item under
/// its name.
void add_markdown(Page& page, const std::string& markdown) {
  std::istringstream lines(markdown);
  std::vector<std::string> header;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) header.clear();
    if (line.starts_with("#")) {
      page.section(line.substr(line.find_first_not_of("# ")));
    } else if (line.starts_with("|")) {
      if (line.find_first_not_of("|-: ") == std::string::npos) continue;
      const std::vector<std::string> cells = cells_of(line);
      if (header.empty()) {
        header = cells;
        continue;
      }
      const auto named = std::find(header.begin(), header.end(), "name");
      const std::size_t term = named == header.end() ? 0 : static_cast<std::size_t>(named - header.begin());
      std::string rest;
      for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) {
        if (i == term || cells[i].empty()) continue;
        const bool speaks = header[i] == "meaning" || header[i] == "words" || header[i] == "type";
        rest += (rest.empty() ? "" : "; ") + (speaks ? cells[i] : header[i] + " " + cells[i]);
      }
      page.item(cells[std::min(term, cells.size() - 1)], rest);
    } else if (!line.empty()) {
      page.paragraph(line);
    }
  }
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
          "limit. Friction holds the cart exactly still up to its level.");
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

std::string registers_page() {
  Page page("cartwright-registers", 5, "Modbus register map of cartwrightd");
  page.section("DESCRIPTION")
      .paragraph(fmt::format(
          "Map version {}, Modbus TCP, port {} by default. cartwrightd --registers prints this map "
          "as Markdown. A refused write gets a Modbus exception and changes nothing.",
          wire::kMapVersion, wire::kDefaultPort));
  add_markdown(page, wire::register_map_markdown());
  page.see_also("cartwrightd(8), cartwright(1)");
  return page.text();
}

std::string session_page() {
  Page page("cartwright-session", 5, "a directory of recordings of a cart");
  page.section("DESCRIPTION")
      .paragraph(
          "session.toml and the CSV files it names, one for each recording. SI units; the unit is the last "
          "part of a name. Positive voltage drives towards positive y.")
      .verbatim(
          "[rig]\n"
          "name = \"cart\"\n"
          "sample_rate_hz = 1000\n"
          "encoder_resolution_m = 2.275e-5\n"
          "voltage_limit_V = 12.0\n"
          "travel_m = [-0.4, 0.4]\n\n"
          "[[recording]]\n"
          "file = \"step_kp60_1.csv\"\n"
          "experiment = \"step\"\n"
          "controller = { type = \"pd\", kp_V_per_m = 60, kd_V_s_per_m = 0, derivative_filter_hz = 50 }\n"
          "repeat_of = \"step_kp60_0.csv\"\n\n"
          "[[recording]]\n"
          "file = \"relay_a.csv\"\n"
          "experiment = \"relay\"\n"
          "controller = { type = \"dual_relay\", h1_V = 2.0, h2_V = 1.5 }");
  page.section("SESSION.TOML")
      .item("[rig]",
            "sample_rate_hz is required; voltage_limit_V is the limit the controller applies to its command")
      .item("file", "beside session.toml")
      .item("experiment", "step, relay, track, sweep, dither or free text")
      .item("repeat_of", "optional: a recording with the same reference and gains")
      .item("controller", "absent for a foreign recording; what needs the control law is then left out");
  page.section("CONTROL LAWS")
      .paragraph("At tick k, Ts = 1/sample_rate_hz, e = r - y.")
      .item("pd",
            "ef += (1 - exp(-2 pi f Ts)) ((e - e_prev)/Ts - ef), u = clip(kp e + kd ef + d_V, "
            "+-voltage_limit); e_prev = e at the first tick. With derivative_on = \"measurement\" (default "
            "\"error\") -y takes the place of e in the derivative.")
      .item("pid",
            "pd with ki_V_per_m_s times the running sum of e Ts, including this tick, added to the voltage; "
            "the sum stands still while the limit acts and e would drive further beyond it.")
      .item("dual_relay",
            "u = clip(h1 sgn(e) + h2 sgn(I) + d_V), I the running sum of e Ts including this tick, "
            "sgn(0) = +1. hysteresis_m (0) makes the first relay change over only that far past zero.");
  page.section("CSV")
      .paragraph(
          "A header line, then one row for each controller tick. Columns by name, in any order; unknown "
          "ones are kept; an empty cell is missing.")
      .item("t_s", "time, strictly increasing; real time stamps, which jitter and may have gaps")
      .item("y_m", "position, read at the row's own t_s")
      .item("u_V", "command after the limit, held until the next row")
      .item("r_m", "reference; required where a controller is given")
      .item("d_V", "voltage added after the control law, before the limit")
      .item("i_A, bus_V, motor_C, status", "optional")
      .item("truth_*", "what only a simulation knows")
      .paragraph(
          "Written files have comma and point, LF, UTF-8 without byte-order mark and shortest round-trip "
          "numbers. Reading also takes a byte-order mark, CRLF, quotes, semicolons or tabs, and then a "
          "decimal comma.");
  page.section("IMPORT MAP")
      .paragraph(
          "cartwright import FILE --map MAP.toml --out DIR turns MATLAB or CSV files into a session. "
          "[channels] has a line for each column; [rig] and [controller] are as above.")
      .verbatim("[channels]\ny_m = \"qm\"\nu_V = { channel = \"vir\", scale = 1.0, offset = 0.0 }");
  page.see_also("cartwright(1), cartwright-model(5)");
  return page.text();
}

}  // namespace cartwright::packaging
