// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Command.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/LogReadOptions.h"

namespace hoctomap {

/// The options that `build` and `segment` share: configuration, logs, poses, choice of scans.
struct LogOptions {
  std::optional<std::string> config;
  std::vector<std::string> overrides;
  std::vector<std::string> logs;
  std::string output;
  std::string poses;
  std::string pose_label;
  std::vector<std::string> sensors;
  std::uint64_t start = 0;
  std::optional<std::uint64_t> end;
  std::uint64_t every = 1;
  std::optional<std::uint64_t> max_scans;
  std::optional<std::string> up;
  bool salvage = false;
  int threads = 0;  ///< 0: all cores
  int verbose = 0;
  bool quiet = false;

  void addTo(CLI::App& command);

  /// @throws ConfigError if the configuration is wrong.
  [[nodiscard]] Settings settings() const;
  /// @throws ConfigError if `--up` is no direction.
  [[nodiscard]] LogReadOptions readOptions(const Settings& settings) const;
  /// Number of threads to work with, at least 1.
  [[nodiscard]] std::size_t threadCount() const;
};

}  // namespace hoctomap
