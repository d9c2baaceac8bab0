#include "host/device/log_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace cartwright::device {
namespace {

using wire::Id;

constexpr int kAttempts = 6;
constexpr std::chrono::milliseconds kFirstPause{
    20};  // doubles with every attempt: 20 ms to 0.6 s, 1.2 s in all

}  // namespace

Answer<LogReader::Page> LogReader::attempt(std::uint64_t row, std::size_t most) {
  if (const auto asked = controller_.write({{Id::log_page_row, static_cast<double>(row)}}); !asked) {
    return tl::unexpected(asked.error());
  }
  const auto head = controller_.read(Id::log_page_rows, Id::log_page_crc);
  if (!head) return tl::unexpected(head.error());
  const auto rows = head->integer<std::size_t>(Id::log_page_rows);
  if (rows == 0) {
    const auto held = controller_.read(Id::log_first_row, Id::log_rows);
    if (!held) return tl::unexpected(held.error());
    const auto oldest = held->integer<std::uint64_t>(Id::log_first_row);
    // The ring moves on while it is read: a row may be gone by the time it is asked for.
    if (oldest > row && oldest < held->integer<std::uint64_t>(Id::log_rows)) return attempt(oldest, most);
    return Page{row, 0, {}};
  }
  constexpr std::size_t kWordsPerNumber = 4;
  const std::size_t words_per_row = columns_ * kWordsPerNumber;
  if (rows * words_per_row > wire::info(Id::log_window).size()) {
    return trouble(Cause::incompatible,
                   fmt::format("the controller announces {} rows of {} numbers in a window of {}", rows,
                               columns_, wire::info(Id::log_window).count));
  }
  const auto words = controller_.read_window(rows * words_per_row);
  if (!words) return tl::unexpected(words.error());
  if (wire::crc32(std::span<const std::uint16_t>(*words)) != head->integer<std::uint32_t>(Id::log_page_crc)) {
    return trouble(Cause::lost, fmt::format("the log page at row {} does not match its checksum", row));
  }
  Page page{row, std::min(rows, most), {}};
  page.numbers.reserve(page.rows * columns_);
  for (std::size_t i = 0; i < page.rows * columns_; ++i) {
    page.numbers.push_back(wire::get_f64(std::span(*words).subspan(i * kWordsPerNumber, kWordsPerNumber)));
  }
  return page;
}

Answer<LogReader::Page> LogReader::page(std::uint64_t row, std::size_t most) {
  auto pause = kFirstPause;
  for (int tries = 1;; ++tries) {
    auto page = attempt(row, most);
    if (page || page.error().cause != Cause::lost || tries == kAttempts) return page;
    std::this_thread::sleep_for(pause);
    pause *= 2;
    // After a broken connection every further request on it would fail too, and stale answers could still
    // come in.
    if (auto again = Controller::connect(controller_.address())) controller_ = std::move(*again);
  }
}

}  // namespace cartwright::device
