// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include <unistd.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "ResidentMemory.h"
#include "Terminal.h"

namespace hoctomap {

namespace {

constexpr double kBarSeconds = 0.1;   // between two drawings of the bar
constexpr double kLineSeconds = 2.0;  // between two plain lines
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(RunLog& log, std::optional<std::uint64_t> total, bool quiet)
    : log_(log),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

std::string Progress::status(std::uint64_t scans, std::optional<std::size_t> nodes) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = elapsed > 0.0 ? static_cast<double>(scans) / elapsed : 0.0;
  std::ostringstream text;
  text << scans;
  if (total_) text << "/" << *total_;
  text << " scans, " << std::fixed << std::setprecision(1) << rate << " scans/s";
  if (nodes) text << ", " << *nodes << (*nodes == 1 ? " node" : " nodes");
  text << ", " << residentMemory().bytes / 1'000'000 << " MB";
  if (total_ && rate > 0.0 && scans <= *total_) {
    text << ", " << durationText(static_cast<double>(*total_ - scans) / rate) << " left";
  }
  return text.str();
}

void Progress::show(std::uint64_t scans, std::optional<std::size_t> nodes) {
  if (quiet_) return;
  const double since = std::chrono::duration<double>(Clock::now() - last_shown_).count();
  const bool last = total_ && scans >= *total_;
  if (since < (terminal_ ? kBarSeconds : kLineSeconds) && !(terminal_ && last)) return;
  last_shown_ = Clock::now();
  if (!terminal_) {
    log_.info(status(scans, nodes));
    return;
  }
  std::string bar;
  if (total_ && *total_ > 0) {
    const auto filled = static_cast<int>(std::min(scans, *total_) * kBarWidth / *total_);
    bar = "[" + coloured(std::string(static_cast<std::size_t>(filled), '#'), Colour::green) +
          std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "] ";
  }
  std::cerr << "\r\033[K" << bar << status(scans, nodes) << std::flush;
  log_.setLineInProgress(true);
}

void Progress::finish() {
  if (quiet_ || !terminal_) return;
  std::cerr << "\r\033[K" << std::flush;
  log_.setLineInProgress(false);
}

}  // namespace hoctomap
