#include "host/device/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace cartwright::device {
namespace {

using wire::Id;

constexpr std::chrono::milliseconds kAskAgain{1};
constexpr std::chrono::seconds kPatience{3};

}  // namespace

Answer<Controller> Controller::connect(const Address& address) {
  auto connection = Connection::open(address);
  if (!connection) return tl::unexpected(connection.error());
  Controller controller(std::move(*connection));
  const auto version = controller.read(Id::map_version);
  if (!version) return tl::unexpected(version.error());
  if (const auto theirs = version->integer<unsigned>(Id::map_version); theirs != wire::kMapVersion) {
    return trouble(
        Cause::incompatible,
        fmt::format("the controller at {} speaks version {} of the register map, this program version {}; "
                    "install the same cartwright on both sides",
                    address.text(), theirs, wire::kMapVersion));
  }
  return controller;
}

Answer<void> Controller::read_words(std::uint16_t address, std::span<std::uint16_t> into) {
  constexpr std::size_t kMost = wire::kMostPerRead / 4 * 4;  // whole 64-bit numbers
  while (!into.empty()) {
    const std::size_t count = std::min(into.size(), kMost);
    if (const auto read = connection_.read(address, into.first(count)); !read) return read;
    into = into.subspan(count);
    address = static_cast<std::uint16_t>(address + count);
  }
  return {};
}

Answer<RegisterBlock> Controller::read(Id first, Id last) {
  RegisterBlock block(first, last);
  const auto all = wire::registers();
  // Stretches of registers without addresses between them that hold nothing.
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last);) {
    const wire::Register& start = all[i];
    const wire::Register* end = &start;
    while (++i <= static_cast<std::size_t>(last) && all[i].address == end->end() &&
           all[i].end() - start.address <= wire::kMostPerRead) {
      end = &all[i];
    }
    const std::span<std::uint16_t> words(block.words_of(start.id).data(),
                                         static_cast<std::size_t>(end->end() - start.address));
    if (const auto read = read_words(start.address, words); !read) return tl::unexpected(read.error());
  }
  return block;
}

Answer<void> Controller::write(const std::vector<Setting>& settings) {
  std::vector<Setting> sorted = settings;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [id, value] : sorted) {
    const wire::Register& what = wire::info(id);
    if (!(value >= what.least && value <= what.most)) {
      return trouble(Cause::refused,
                     fmt::format("{} = {} is outside [{}, {}]", what.name, value, what.least, what.most));
    }
  }
  for (std::size_t i = 0; i < sorted.size();) {
    const std::uint16_t address = wire::info(sorted[i].first).address;
    std::vector<std::uint16_t> words;
    do {
      const wire::Register& what = wire::info(sorted[i].first);
      words.resize(words.size() + what.size());
      wire::put(what, std::span(words).last(what.size()), sorted[i].second);
      ++i;
    } while (i < sorted.size() && wire::info(sorted[i].first).address == address + words.size());
    if (const auto written = connection_.write(address, words); !written) return written;
  }
  return {};
}

Answer<void> Controller::command(wire::Command command, std::uint16_t argument) {
  const auto before = read(Id::ack_sequence);
  if (!before) return tl::unexpected(before.error());
  const auto last = before->integer<std::uint16_t>(Id::ack_sequence);
  const auto sequence = static_cast<std::uint16_t>(last == 65535 ? 1 : last + 1);
  const auto written = write({{Id::command_sequence, sequence},
                              {Id::command_code, static_cast<double>(command)},
                              {Id::command_argument, argument}});
  if (!written) return written;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto answer = read(Id::ack_sequence, Id::ack_text);
    if (!answer) return tl::unexpected(answer.error());
    const auto ack = answer->code<wire::Ack>(Id::ack_result);
    if (answer->integer<std::uint16_t>(Id::ack_sequence) == sequence && ack != wire::Ack::pending) {
      if (ack == wire::Ack::done) return {};
      const std::string said = answer->text(Id::ack_text);
      return trouble(
          Cause::refused,
          fmt::format(
              "the controller refuses to {}: {}", wire::name(command),
              said.empty() ? std::string(wire::words(answer->code<wire::Reason>(Id::ack_reason))) : said));
    }
    std::this_thread::sleep_for(kAskAgain);
  }
  return trouble(Cause::lost,
                 fmt::format("the controller at {} took no notice of {} for {} s; is its loop running?",
                             address().text(), wire::name(command), kPatience.count()));
}

Answer<std::vector<std::uint16_t>> Controller::read_window(std::size_t words) {
  std::vector<std::uint16_t> window(words);
  if (const auto read = read_words(wire::info(Id::log_window).address, window); !read) {
    return tl::unexpected(read.error());
  }
  return window;
}

}  // namespace cartwright::device
