#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/cli/progress.hpp"
#include "host/report/report.hpp"
#include "host/reproduce/reproduction.hpp"

namespace cartwright::cli {
namespace {

using reproduce::Paper;
using reproduce::ReproduceOptions;
using reproduce::Section;

struct Options {
  std::string paper, out;
  std::vector<std::string> items;
  ReproduceOptions reproduce;
  bool json = false, list = false;
};

struct PaperTable {
  std::string key, title;
  std::vector<Section> sections;
};

/// A paper is one entry here.
std::vector<Paper> papers() {
  return {reproduce::damping_paper(), reproduce::relay_paper()};
}

template <typename Range, typename Key>
std::string joined(const Range& range, Key key) {
  std::string out;
  for (const auto& one : range) out += (out.empty() ? "" : ", ") + key(one);
  return out;
}

std::vector<std::string> all_items() {
  std::vector<std::string> out;
  for (const Paper& paper : papers()) {
    for (const auto& experiment : paper.experiments) out.push_back(experiment.key);
  }
  return out;
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

void print_list() {
  for (const Paper& paper : papers()) {
    fmt::print("{}: {}\n", paper.key, paper.title);
    for (const auto& experiment : paper.experiments)
      fmt::print("  {:<14} {}\n", experiment.key, experiment.about);
  }
}

/// Characters of a UTF-8 text: its bytes less the continuation bytes.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Columns as wide as their widest cell; units beside the headings.
void print_table(const report::Table& table) {
  std::vector<std::vector<std::string>> lines(1);
  for (const auto& column : table.columns)
    lines[0].push_back(column.unit.empty() ? column.heading
                                           : fmt::format("{} [{}]", column.heading, column.unit));
  for (const auto& row : table.rows) {
    auto& line = lines.emplace_back();
    for (const auto& cell : row) line.push_back(cell.text);
  }
  fmt::print("\n  {}\n", table.caption);
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, characters(other[c]));
      fmt::print("{}{:>{}}", c > 0 ? "  " : "    ", line[c], width);
    }
    fmt::print("\n");
  }
}

void print_text(const PaperTable& table) {
  fmt::print("{}\n", table.title);
  for (const auto& section : table.sections) {
    fmt::print("\n{}\n", section.heading);
    for (const auto& item : section.items) {
      fmt::print("  {}\n", item.item);
      if (!item.published.empty()) fmt::print("    published  {}\n", item.published);
      fmt::print("    obtained   {}\n", item.obtained);
      if (!item.why.empty()) fmt::print("    why        {}\n", item.why);
    }
    for (const auto& shown : section.tables) print_table(shown);
  }
}

nlohmann::ordered_json to_json(const Section& section, const report::Table& table) {
  nlohmann::ordered_json out = {{"section", section.heading}, {"caption", table.caption}};
  for (const auto& column : table.columns) {
    out["columns"].push_back(column.unit.empty() ? column.heading
                                                 : fmt::format("{} [{}]", column.heading, column.unit));
  }
  for (const auto& row : table.rows) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const auto& cell : row) cells.push_back(cell.text);
    out["rows"].push_back(std::move(cells));
  }
  return out;
}

nlohmann::ordered_json to_json(const PaperTable& table) {
  nlohmann::ordered_json out = {{"paper", table.key},
                                {"title", table.title},
                                {"items", nlohmann::ordered_json::array()},
                                {"tables", nlohmann::ordered_json::array()}};
  for (const auto& section : table.sections) {
    for (const auto& item : section.items) {
      out["items"].push_back({{"section", section.heading},
                              {"item", item.item},
                              {"published", item.published},
                              {"obtained", item.obtained},
                              {"why", item.why}});
    }
    for (const auto& shown : section.tables) out["tables"].push_back(to_json(section, shown));
  }
  return out;
}

void add_to(report::Report& page, const PaperTable& table) {
  page.section(table.title);
  for (const auto& section : table.sections) {
    page.subsection(section.heading);
    report::Table shown{.columns = {{"item"}, {"published"}, {"obtained"}, {"why they differ"}}};
    for (const auto& item : section.items) shown.row({item.item, item.published, item.obtained, item.why});
    page.table(shown);
    for (const auto& further : section.tables) page.table(further);
    if (!section.plots.empty()) page.plots(section.plots, section.plot_columns);
  }
}

Result<PaperTable> reproduce_paper(const Paper& paper, const Options& options) {
  PaperTable table{paper.key, paper.title, {}};
  for (const auto& experiment : paper.experiments) {
    if (!options.items.empty() && !contains(options.items, experiment.key)) continue;
    ProgressBar bar(paper.key + " " + experiment.key);
    ReproduceOptions with_bar = options.reproduce;
    with_bar.progress = [&bar](double part) { bar.show(part); };
    bar.show(0);
    auto section = experiment.run(with_bar);
    if (!section)
      return failure(fmt::format("{} {}: {}", paper.key, experiment.key, section.error().message));
    table.sections.push_back(*std::move(section));
  }
  return table;
}

Outcome run(const Options& options) {
  if (options.list) {
    print_list();
    return Status::done;
  }
  const auto known = papers();
  const auto key_of = [](const Paper& paper) { return paper.key; };
  if (!options.paper.empty() && !contains({known[0].key, known[1].key}, options.paper)) {
    return failure(
        fmt::format("--paper {}: no such paper; {} are there", options.paper, joined(known, key_of)));
  }
  for (const std::string& item : options.items) {
    if (contains(all_items(), item)) continue;
    return failure(fmt::format("--item {}: no such item; {} are there", item,
                               joined(all_items(), [](const std::string& key) { return key; })));
  }
  std::vector<PaperTable> tables;
  for (const Paper& paper : known) {
    if (!options.paper.empty() && paper.key != options.paper) continue;
    auto table = reproduce_paper(paper, options);
    if (!table) return tl::unexpected(table.error());
    if (!table->sections.empty()) tables.push_back(*std::move(table));
  }
  if (tables.empty())
    return failure(fmt::format("--paper {} holds none of the items asked for", options.paper));
  if (!options.out.empty()) {
    report::Report page("The papers, reproduced", "published and obtained, side by side");
    for (const PaperTable& table : tables) add_to(page, table);
    if (const auto written = page.write(options.out); !written) return tl::unexpected(written.error());
  }
  if (options.json) {
    nlohmann::ordered_json out = {{"papers", nlohmann::ordered_json::array()}};
    for (const PaperTable& table : tables) out["papers"].push_back(to_json(table));
    fmt::print("{}\n", out.dump(2));
  } else {
    for (const PaperTable& table : tables) print_text(table);
  }
  return Status::done;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("reproduce", "Recompute what the papers print and show both");
  command->footer(
      "Examples:\n"
      "  cartwright reproduce --out papers.html\n"
      "  cartwright reproduce --paper damping\n"
      "  cartwright reproduce --item table2 --item design\n"
      "  cartwright reproduce --list");
  auto options = std::make_shared<Options>();
  command->add_option("--paper", options->paper, "one paper alone: damping or relay");
  command->add_option("--item", options->items, "these items alone (see --list); may be repeated");
  command->add_flag("--list", options->list, "name the papers and their items");
  command->add_option("--out", options->out, "write tables and plots to this HTML page as well");
  command
      ->add_option("--draws", options->reproduce.draws,
                   "noise draws of each sine-fit example; the cart experiments take a tenth")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on standard output");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
