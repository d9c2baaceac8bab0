#pragma once

#include <string>
#include <string_view>

#include "common/model/model.hpp"
#include "common/result.hpp"

namespace cartwright {

/// Reads a model from the text of a TOML file; `source` names the file in messages. Unknown tables and keys,
/// missing or out-of-range numbers are errors that say what would be right. Tables outside `[model]` are left
/// alone.
Result<Model> model_from_toml(std::string_view text, std::string_view source);

/// The text of a model file. Numbers are shortest round-trip; optional parameters at their default are left
/// out.
std::string to_toml(const Model& model);

}  // namespace cartwright
