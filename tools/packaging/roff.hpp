#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace cartwright::packaging {

/// Text as it must stand in a man page: backslashes and hyphens escaped, no line that looks like a request.
inline std::string roff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    line_start = c == '\n';
  }
  return out;
}

/// A man page, from the top down.
class Page {
 public:
  Page(std::string_view name, int section, std::string_view what) {
    text_ = fmt::format(".TH \"{}\" {} \"\" \"Cartwright {}\"\n.SH NAME\n{} \\- {}\n", name, section,
                        CARTWRIGHT_VERSION, roff(name), roff(what));
  }
  Page& section(std::string_view title) { return add(fmt::format(".SH \"{}\"\n", roff(title))); }
  Page& subsection(std::string_view title) { return add(fmt::format(".SS \"{}\"\n", roff(title))); }
  Page& paragraph(std::string_view text) { return add(fmt::format(".PP\n{}\n", roff(text))); }
  Page& item(std::string_view term, std::string_view text) {
    return add(fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(term), roff(text)));
  }
  Page& verbatim(std::string_view text) { return add(fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text))); }
  Page& see_also(std::string_view pages) { return section("SEE ALSO").paragraph(pages); }
  const std::string& text() const { return text_; }

 private:
  Page& add(std::string_view more) {
    text_ += more;
    return *this;
  }
  std::string text_;
};

}  // namespace cartwright::packaging
