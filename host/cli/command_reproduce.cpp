#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/report/report.hpp"
#include "host/reproduce/reproduction.hpp"

namespace cartwright::cli {
namespace {

using reproduce::PaperTable;
using reproduce::ReproduceOptions;

struct Paper {
  std::string key;
  std::function<Result<PaperTable>(const ReproduceOptions&)> table;
};

/// A paper is one entry here.
const std::vector<Paper>& papers() {
  static const std::vector<Paper> all = {{"relay", reproduce::relay_paper}};
  return all;
}

struct Options {
  std::string paper, out;
  ReproduceOptions reproduce;
  bool json = false;
};

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
  }
}

nlohmann::ordered_json to_json(const PaperTable& table) {
  nlohmann::ordered_json out = {
      {"paper", table.key}, {"title", table.title}, {"items", nlohmann::ordered_json::array()}};
  for (const auto& section : table.sections) {
    for (const auto& item : section.items) {
      out["items"].push_back({{"section", section.heading},
                              {"item", item.item},
                              {"published", item.published},
                              {"obtained", item.obtained},
                              {"why", item.why}});
    }
  }
  return out;
}

void add_to(report::Report& page, const PaperTable& table) {
  page.section(table.title);
  for (const auto& section : table.sections) {
    report::Table shown{.caption = section.heading,
                        .columns = {{"item"}, {"published"}, {"obtained"}, {"why they differ"}}};
    for (const auto& item : section.items) shown.row({item.item, item.published, item.obtained, item.why});
    page.table(shown);
  }
}

Outcome run(const Options& options) {
  std::vector<PaperTable> tables;
  for (const Paper& paper : papers()) {
    if (!options.paper.empty() && paper.key != options.paper) continue;
    auto table = paper.table(options.reproduce);
    if (!table) return failure(fmt::format("{}: {}", paper.key, table.error().message));
    tables.push_back(*std::move(table));
  }
  if (tables.empty()) return failure(fmt::format("--paper {}: no such paper; relay is one", options.paper));
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
      "  cartwright reproduce\n"
      "  cartwright reproduce --paper relay --out papers.html");
  auto options = std::make_shared<Options>();
  command->add_option("--paper", options->paper, "one paper alone: relay");
  command->add_option("--out", options->out, "write the tables to this HTML file as well");
  command->add_option("--draws", options->reproduce.draws, "noise draws of each example")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on standard output");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
