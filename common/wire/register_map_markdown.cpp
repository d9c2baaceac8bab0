#include <fmt/format.h>

#include "common/wire/codes.hpp"
#include "common/wire/register_map.hpp"

namespace cartwright::wire {
namespace {

std::string_view type_name(const Register& r) {
  switch (r.type) {
    case Type::u16:
      return "u16";
    case Type::u32:
      return "u32";
    case Type::u64:
      return "u64";
    case Type::f32:
      return "f32";
    case Type::f64:
      return "f64";
    case Type::text:
      return "text";
  }
  return "";
}

std::string_view access_name(Access access) {
  switch (access) {
    case Access::read:
      return "read";
    case Access::command:
      return "command";
    case Access::select:
      return "select";
  }
  return "";
}

template <typename Code>
std::string codes(std::string_view title, std::uint16_t count) {
  std::string text = fmt::format("\n### {}\n\n| code | name | meaning |\n| --- | --- | --- |\n", title);
  for (std::uint16_t i = 0; i < count; ++i) {
    const auto code = static_cast<Code>(i);
    text += fmt::format("| {} | {} | {} |\n", i, name(code), words(code));
  }
  return text;
}

}  // namespace

std::string register_map_markdown() {
  std::string text = fmt::format(
      "## Register map, version {}\n\n"
      "Addresses count from 0. Every register can be read with function 3 or 4; those marked `command` are "
      "written with function 6 or 16 by the one client that commands, those marked `select` by anyone for "
      "itself. A value of several registers has its most significant register first and is written "
      "whole.\n\n"
      "| address | registers | type | unit | access | range | initial | name | meaning |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      kMapVersion);
  for (const Register& r : registers()) {
    const std::string range = r.writable() ? fmt::format("{} to {}", r.least, r.most) : "";
    const std::string initial = r.writable() ? fmt::format("{}", r.initial) : "";
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | `{}` | {} |\n", r.address, r.size(),
                        type_name(r), r.unit, access_name(r.access), range, initial, r.name, r.meaning);
  }
  text += "\n## Codes\n";
  text += codes<State>("state", kStateCount);
  text += codes<Fault>("fault", kFaultCount);
  text += codes<Limited>("limited_by", kLimitedCount);
  text += codes<ExperimentKind>("experiment", kExperimentKindCount);
  text += codes<Outcome>("outcome", kOutcomeCount);
  text += codes<Command>("command_code", kCommandCount);
  text += codes<Ack>("ack_result", kAckCount);
  text += codes<Reason>("ack_reason", kReasonCount);
  text += codes<Notice>("notice", kNoticeCount);
  return text;
}

}  // namespace cartwright::wire
