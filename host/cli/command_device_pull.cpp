#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "host/cli/device_pull.hpp"
#include "host/cli/progress.hpp"

namespace cartwright::cli {

Outcome pull_into(device::Controller& controller, device::Range range, const std::string& directory) {
  const auto fetched = [&] {
    ProgressBar bar("fetching");
    return device::download(controller, range, [&bar](double part) { bar.show(part); });
  }();
  if (!fetched) return conclude(fetched.error());
  if (fetched->session.recordings.empty()) {
    return failure(
        fmt::format("the log of the controller at {} holds no rows of these recordings any more; run the "
                    "experiment again",
                    controller.address().text()));
  }
  const auto written = write_session(fetched->session, directory);
  if (!written) return tl::unexpected(written.error());
  std::size_t rows = 0;
  for (const Recording& recording : fetched->session.recordings) rows += recording.size();
  const std::size_t count = fetched->session.recordings.size();
  fmt::print("{}: {} recording{}, {} rows\n", directory, count, count == 1 ? "" : "s", rows);
  for (const std::string& loss : fetched->losses) fmt::print("lost: {}\n", loss);
  return Status::done;
}

namespace {

Outcome run(const device::Address& address, const std::string& out, std::size_t last) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto count = device::recording_count(*controller);
  if (!count) return conclude(count.error());
  if (*count == 0) {
    fmt::print(stderr,
               "cartwright: the controller at {} has no recordings yet; see cartwright device run --help\n",
               address.text());
    return Status::no;
  }
  return pull_into(*controller, {last == 0 ? 0 : *count - std::min(last, *count), *count}, out);
}

}  // namespace

void add_device_pull(CLI::App& device, int& exit_status) {
  CLI::App* command =
      device.add_subcommand("pull", "Fetch the recordings in the controller's log into a session");
  command->footer(
      "Every page is checked against its checksum and asked for again if damaged; a broken\n"
      "connection is made anew. The directory appears whole or not at all. Losses are named, and\n"
      "show in t_s and missed_ticks.\n\n"
      "Examples:\n"
      "  cartwright device pull --out rig/monday\n"
      "  cartwright device pull --out rig/last --last 1");
  const auto address = add_address(command);
  auto out = std::make_shared<std::string>();
  auto last = std::make_shared<std::size_t>(0);
  command->add_option("--out", *out, "directory to write the session to")->required();
  command->add_option("--last", *last, "only this many, the newest (default: all)")
      ->check(CLI::PositiveNumber);
  on_run(command, exit_status, [address, out, last] { return run(*address, *out, *last); });
}

}  // namespace cartwright::cli
