#include "host/report/report.hpp"

#include <algorithm>

#include "host/report/assets.hpp"
#include "host/report/html.hpp"
#include "host/session/files.hpp"

namespace cartwright::report {
namespace {

std::string assets_ending_in(std::string_view ending) {
  std::string out;
  for (const Asset& asset : assets()) {
    if (asset.name.ends_with(ending)) out += asset.text;
  }
  return out;
}

/// JSON inside a script element: "</script" or "<!--" in a text would end or change the element.
std::string inside_script(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

bool same_series(const Plot& a, const Plot& b) {
  return std::equal(a.series.begin(), a.series.end(), b.series.begin(), b.series.end(),
                    [](const Series& one, const Series& other) {
                      return one.name == other.name && one.mark == other.mark && one.colour == other.colour;
                    });
}

struct ToneWords {
  const char *name, *sign;
};

ToneWords words_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return {"good", "\u2713"};
    case Tone::attention:
      return {"attention", "!"};
    case Tone::bad:
      return {"bad", "\u2717"};
    case Tone::plain:
      break;
  }
  return {"plain", "\u2192"};
}

}  // namespace

Report& Report::verdict(Tone tone, std::string_view sentence, std::string_view detail) {
  const ToneWords words = words_of(tone);
  body_ += std::string("<div class=\"verdict ") + words.name +
           "\" role=\"status\"><span class=\"sign\" aria-hidden=\"true\">" + words.sign +
           "</span><div><p class=\"sentence\">" + escape(sentence) + "</p>";
  if (!detail.empty()) body_ += "<p>" + escape(detail) + "</p>";
  body_ += "</div></div>\n";
  return *this;
}

Report& Report::section(std::string_view heading) {
  std::string name = anchor(heading);
  const auto taken = [&](const std::string& candidate) {
    return std::any_of(contents_.begin(), contents_.end(),
                       [&](const auto& c) { return c.first == candidate; });
  };
  for (int number = 2; taken(name); ++number) name = anchor(heading) + "-" + std::to_string(number);
  contents_.emplace_back(name, heading);
  body_ += "<h2 id=\"" + name + "\">" + escape(heading) + "</h2>\n";
  return *this;
}

Report& Report::subsection(std::string_view heading) {
  body_ += "<h3>" + escape(heading) + "</h3>\n";
  return *this;
}

Report& Report::paragraph(std::string_view text) {
  body_ += "<p>" + escape(text) + "</p>\n";
  return *this;
}

Report& Report::note(std::string_view text) {
  body_ += "<p class=\"note\">" + escape(text) + "</p>\n";
  return *this;
}

Report& Report::list(const std::vector<std::string>& items) {
  body_ += "<ul>";
  for (const std::string& item : items) body_ += "<li>" + escape(item) + "</li>";
  body_ += "</ul>\n";
  return *this;
}

Report& Report::code(std::string_view text) {
  body_ += "<pre>" + escape(text) + "</pre>\n";
  return *this;
}

Report& Report::facts(const std::vector<std::pair<std::string, std::string>>& pairs) {
  body_ += "<dl class=\"facts\">";
  for (const auto& [name, text] : pairs)
    body_ += "<div><dt>" + escape(name) + "</dt><dd>" + escape(text) + "</dd></div>";
  body_ += "</dl>\n";
  return *this;
}

Report& Report::table(const Table& table) {
  body_ += report::to_html(table);
  return *this;
}

std::string Report::plot_html(const Plot& plot, bool own_legend) {
  const std::string number = std::to_string(plots_.size());
  plots_.push_back(to_json(plot, pool_));
  std::string out = "<figure class=\"plot\" data-plot=\"" + number + "\">";
  if (!plot.title.empty()) out += "<h4>" + escape(plot.title) + "</h4>";
  if (own_legend) out += "<div class=\"legend\"></div>";
  out += "<div class=\"area\" style=\"min-height:" + std::to_string(plot.height_px) +
         "px\"><noscript>This plot needs JavaScript.</noscript></div>";
  if (!plot.caption.empty()) out += "<figcaption>" + escape(plot.caption) + "</figcaption>";
  return out + "</figure>\n";
}

Report& Report::plot(const Plot& plot) {
  body_ += plot_html(plot);
  return *this;
}

Report& Report::plots(const std::vector<Plot>& plots, int columns) {
  body_ += "<div class=\"multiples\" style=\"--columns:" + std::to_string(std::max(1, columns)) + "\">\n";
  const bool shared = plots.size() > 1 && std::all_of(plots.begin(), plots.end(), [&](const Plot& plot) {
                        return same_series(plot, plots.front());
                      });
  if (shared) body_ += "<div class=\"legend\"></div>";
  for (const Plot& plot : plots) body_ += plot_html(plot, !shared);
  body_ += "</div>\n";
  return *this;
}

Report& Report::details(std::string_view summary, const std::function<void(Report&)>& fill) {
  body_ += "<details><summary>" + escape(summary) + "</summary><div class=\"inside\">\n";
  fill(*this);
  body_ += "</div></details>\n";
  return *this;
}

std::string Report::to_html() const {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escape(title_) + "</title>\n<style>\n" + assets_ending_in(".css") + "</style>\n</head>\n<body>\n";
  out += "<nav aria-label=\"Contents\"><p class=\"brand\">Cartwright</p><ol>";
  for (const auto& [name, heading] : contents_)
    out += "<li><a href=\"#" + name + "\">" + escape(heading) + "</a></li>";
  out += "</ol></nav>\n<main>\n<header><h1>" + escape(title_) + "</h1>";
  if (!subtitle_.empty()) out += "<p class=\"subtitle\">" + escape(subtitle_) + "</p>";
  out += "</header>\n" + body_ + "</main>\n";
  if (!plots_.empty()) {
    std::string data = "{\"arrays\":" + pool_.to_json() + ",\n\"plots\":[";
    for (std::size_t i = 0; i < plots_.size(); ++i) data += (i ? ",\n" : "") + plots_[i];
    data += "]}";
    out += "<script type=\"application/json\" id=\"data\">\n" + inside_script(data) +
           "\n</script>\n<script>\n" + assets_ending_in(".js") + "</script>\n";
  }
  return out + "</body>\n</html>\n";
}

Result<void> Report::write(const std::filesystem::path& file) const {
  return write_file(file, to_html());
}

}  // namespace cartwright::report
