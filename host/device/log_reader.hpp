#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/device/controller.hpp"

namespace cartwright::device {

/// Rows of the controller's log by their number, page by page, with checksums, retries and reconnection.
class LogReader {
 public:
  explicit LogReader(Controller& controller, std::size_t columns)
      : controller_(controller), columns_(columns) {}

  struct Page {
    std::uint64_t first_row = 0;
    std::size_t rows = 0;
    std::vector<double> numbers;  ///< row after row
  };

  /// The page that starts at `row`; if the ring has lost that row, at the oldest row it still holds. No more
  /// than `most` rows. Empty if nothing at or after `row` is held.
  Answer<Page> page(std::uint64_t row, std::size_t most);

 private:
  Answer<Page> attempt(std::uint64_t row, std::size_t most);

  Controller& controller_;
  std::size_t columns_;
};

}  // namespace cartwright::device
