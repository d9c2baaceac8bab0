// Any text either is refused in one line or is a model; a model that is written and read again is the same
// model.
#include <cstdint>
#include <cstdlib>

#include "common/config/controller_toml.hpp"
#include "common/config/model_toml.hpp"
#include "common/config/toml_reader.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cartwright;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto model = model_from_toml(text, "fuzz.toml");
  if (model) {
    const std::string written = to_toml(*model);
    const auto again = model_from_toml(written, "again.toml");
    require(again.has_value() && to_toml(*again) == written);
  } else {
    require(model.error().message.starts_with("fuzz.toml"));
  }
  const auto document = parse_toml(text, "fuzz.toml");
  if (!document) return 0;
  const TomlReader root(*document, "fuzz.toml");
  if (const auto rig = rig_from_toml(root)) require(rig->travel_m[0] < rig->travel_m[1]);
  if (const auto entries = root.tables("recording")) {
    for (const TomlReader& entry : *entries) (void)controller_from_toml(entry);
  }
  return 0;
}
