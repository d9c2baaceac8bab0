#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/packaging/roff.hpp"

namespace cartwright::packaging {

/// Adds Markdown as this project writes it to a man page: headings, paragraphs, tables, and blocks indented
/// by four. A table's row becomes an item under its name, or under its first cell where no column is named
/// so. Of a document only the sections with these headings are taken, in its order; without any, all of it.
/// Throws where one of them is not there, so that no page loses a part in silence.
void add_markdown(Page& page, const std::string& markdown,
                  const std::vector<std::string_view>& sections = {});

}  // namespace cartwright::packaging
