#include "tools/packaging/markdown.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace cartwright::packaging {
namespace {

/// Without the marks of code and emphasis.
std::string plain(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') continue;
    if (text.substr(i, 2) == "**") {
      ++i;
      continue;
    }
    out += text[i];
  }
  return out;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream rest(row.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) {
    const auto first = cell.find_first_not_of(' ');
    const auto last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : plain(cell.substr(first, last - first + 1)));
  }
  return cells;
}

class Writer {
 public:
  Writer(Page& page, const std::vector<std::string_view>& sections)
      : page_(page), sections_(sections), wanted_(sections.empty()) {}

  void line(const std::string& text) {
    if (text.starts_with("#")) return heading(text.substr(text.find_first_not_of("# ")));
    if (!wanted_) return;
    if (text.starts_with("    ")) {
      flush_paragraph();
      block_ += text.substr(4) + '\n';
    } else if (text.empty() && !block_.empty()) {
      block_ += '\n';  // a gap inside the block, or its end
    } else if (text.starts_with("|")) {
      finish();
      row(text);
    } else if (text.empty()) {
      finish();
      header_.clear();
    } else {
      flush_block();
      header_.clear();
      paragraph_ += (paragraph_.empty() ? "" : " ") + plain(text);
    }
  }

  void finish() {
    flush_paragraph();
    flush_block();
  }
  std::size_t found() const { return found_; }

 private:
  void heading(const std::string& title) {
    finish();
    header_.clear();
    wanted_ = sections_.empty() || std::find(sections_.begin(), sections_.end(), title) != sections_.end();
    if (!wanted_) return;
    ++found_;
    std::string capitals = plain(title);
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    page_.section(capitals);
  }

  void row(const std::string& text) {
    if (text.find_first_not_of("|-: ") == std::string::npos) return;
    const std::vector<std::string> cells = cells_of(text);
    if (header_.empty()) {
      header_ = cells;
      // A column "key of [rig]" says whose keys these are.
      if (!cells.empty() && cells[0].starts_with("key ")) page_.paragraph("K" + cells[0].substr(1) + ":");
      return;
    }
    const auto named = std::find(header_.begin(), header_.end(), "name");
    const std::size_t term = named == header_.end() ? 0 : static_cast<std::size_t>(named - header_.begin());
    std::string rest;
    for (std::size_t i = 0; i < std::min(cells.size(), header_.size()); ++i) {
      if (i == term || cells[i].empty() || cells[i] == "none") continue;
      const bool speaks =
          header_[i] == "meaning" || header_[i] == "words" || header_[i] == "type" || cells[i] == "required";
      rest += (rest.empty() ? "" : "; ") + (speaks ? cells[i] : header_[i] + " " + cells[i]);
    }
    page_.item(cells[std::min(term, cells.size() - 1)], rest);
  }

  void flush_paragraph() {
    if (!paragraph_.empty()) page_.paragraph(paragraph_);
    paragraph_.clear();
  }

  void flush_block() {
    while (block_.ends_with('\n')) block_.pop_back();
    if (!block_.empty()) page_.verbatim(block_);
    block_.clear();
  }

  Page& page_;
  const std::vector<std::string_view>& sections_;
  bool wanted_;
  std::size_t found_ = 0;
  std::vector<std::string> header_;
  std::string paragraph_, block_;
};

}  // namespace

void add_markdown(Page& page, const std::string& markdown, const std::vector<std::string_view>& sections) {
  Writer writer(page, sections);
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) writer.line(line);
  writer.finish();
  if (!sections.empty() && writer.found() != sections.size())
    throw std::runtime_error("a README has lost a section that a man page takes from it");
}

}  // namespace cartwright::packaging
