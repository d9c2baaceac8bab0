#include "host/diagnose/show/drive_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/diagnose/judge/name_from_drive.hpp"

namespace cartwright {

using namespace report;

namespace {

/// The recording with most windows, in the order of its way.
std::vector<std::size_t> shown_windows(const DriveBalance& drive, const Session& session) {
  std::vector<std::vector<std::size_t>> own(session.recordings.size());
  for (std::size_t i = 0; i < drive.windows.size(); ++i) own[drive.windows[i].recording].push_back(i);
  std::vector<std::size_t> most =
      *std::max_element(own.begin(), own.end(), [](auto& a, auto& b) { return a.size() < b.size(); });
  std::sort(most.begin(), most.end(), [&](std::size_t a, std::size_t b) {
    return drive.windows[a].position_m < drive.windows[b].position_m;
  });
  return most;
}

}  // namespace

void add_drive(Report& page, const DriveBalance& drive, const Session& session) {
  page.subsection("What the drive balances");
  page.paragraph(statement_of_drive(drive));
  Table left{"What the drive balances besides friction, root mean square of windows of 50 ms",
             {{"windows"}, {"friction alone", "V"}, {"with the lines", "V"}}};
  left.row({"all", Cell::number(drive.missing_V, 3), Cell::number(drive.left_V, 3)});
  left.row({"in quarters of the way that were not used", Cell::number(drive.unseen_missing_V, 3),
            Cell::number(drive.unseen_left_V, 3).emphasise()});
  page.table(left);
  Table lines{"Lines of the drive over the way, highest first",
              {{"period", "mm"}, {"height", "V"}, {"log-likelihood gain", "nats"}, {"in the model"}}};
  for (std::size_t i = 0; i < drive.lines.size(); ++i) {
    const DriveLine& line = drive.lines[i];
    const Estimate& p = line.period_m;
    lines.row({Estimate{1e3 * p.value, 1e3 * p.low, 1e3 * p.high}, line.height_V, Cell::number(line.gain, 3),
               i < drive.held ? "yes" : "no"});
  }
  page.table(lines);
  const std::vector<std::size_t> shown = shown_windows(drive, session);
  Plot plot;
  plot.title = fmt::format("{}: the drive over the way",
                           session.recordings[drive.windows[shown.front()].recording].file);
  plot.x = {"position", "mm"};
  plot.y = {"drive, means of 50 ms", "V"};
  Series measured{"measured"}, predicted{"friction and lines"};
  measured.mark = Mark::points;
  measured.colour = Colour::measured;
  predicted.colour = Colour::model;
  for (const std::size_t i : shown) {
    measured.x.push_back(1e3 * drive.windows[i].position_m);
    measured.y.push_back(drive.windows[i].drive_V);
    predicted.y.push_back(drive.predicted_V[i]);
  }
  predicted.x = measured.x;
  plot.add(measured);
  plot.add(predicted);
  page.plot(plot);
}

}  // namespace cartwright
