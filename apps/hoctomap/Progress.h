// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "RunLog.h"

namespace hoctomap {

/// How far a run is: a bar on a terminal, otherwise a plain line every few seconds. On stderr.
class Progress {
 public:
  Progress(RunLog& log, std::optional<std::uint64_t> total, bool quiet);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param scans scans done, skipped ones included  @param nodes nodes of the map, if there is one
  void show(std::uint64_t scans, std::optional<std::size_t> nodes);
  /// Clears the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string status(std::uint64_t scans, std::optional<std::size_t> nodes) const;

  RunLog& log_;
  std::optional<std::uint64_t> total_;
  bool quiet_;
  bool terminal_;
  Clock::time_point start_;
  Clock::time_point last_shown_;
};

}  // namespace hoctomap
