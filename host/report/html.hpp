#pragma once

#include <string>
#include <string_view>

namespace cartwright::report {

/// Text as HTML shows it: & < > " ' escaped, so that it is safe between tags and in quoted attributes.
std::string escape(std::string_view text);

/// A heading as an anchor: lower-case letters, digits and hyphens.
std::string anchor(std::string_view heading);

}  // namespace cartwright::report
