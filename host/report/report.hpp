#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "host/report/data_pool.hpp"
#include "host/report/plot.hpp"
#include "host/report/table.hpp"

namespace cartwright::report {

/// One page, one file: a title, sections of text, tables and plots that zoom. Nothing is loaded from
/// anywhere, all text is escaped, and the same calls give the same bytes (no date unless one is passed in).
///
///     Report report{"Cart, Monday", "ten recordings, 68 s"};
///     report.verdict(Tone::good, "Nothing beyond noise.");
///     report.section("Recordings");
///     report.plot(plot);
///     report.write("build/report.html");
class Report {
 public:
  explicit Report(std::string title, std::string subtitle = "")
      : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

  /// The answer in one sentence, and what it rests on. Stands where it is called: call it first.
  Report& verdict(Tone tone, std::string_view sentence, std::string_view detail = "");

  /// Opens a section; it appears in the contents.
  Report& section(std::string_view heading);
  Report& subsection(std::string_view heading);
  Report& paragraph(std::string_view text);
  Report& note(std::string_view text);  ///< small print
  Report& list(const std::vector<std::string>& items);
  Report& code(std::string_view text);  ///< commands and files, as they are

  /// What was run, on what: pairs of a name and a text.
  Report& facts(const std::vector<std::pair<std::string, std::string>>& pairs);
  Report& table(const Table& table);
  Report& plot(const Plot& plot);

  /// Small multiples, so many beside each other on a screen. Where all hold the same series one legend serves
  /// them.
  Report& plots(const std::vector<Plot>& plots, int columns);

  /// What `fill` adds is folded away below `summary` until it is asked for.
  Report& details(std::string_view summary, const std::function<void(Report&)>& fill);

  std::string to_html() const;

  /// Writes the page; whole or not at all.
  Result<void> write(const std::filesystem::path& file) const;

 private:
  std::string plot_html(const Plot& plot, bool own_legend = true);

  std::string title_, subtitle_;
  std::string body_;
  std::vector<std::pair<std::string, std::string>> contents_;  ///< anchor, heading
  std::vector<std::string> plots_;                             ///< JSON
  DataPool pool_;
};

}  // namespace cartwright::report
