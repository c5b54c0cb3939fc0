// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vi_a/KnownRuns.h"
#include "vi_a/Results.h"

namespace hoctomap {

struct ViAOptions {
  std::filesystem::path output;
  std::string config;  ///< INI; its resolution of objects is replaced
  int repeats = 5;
  int stock_repeats = 5;                               ///< of all scans with stock, which take longest
  std::vector<double> resolutions_mm{16, 8, 4, 2, 1};  ///< coarsest first, each half of the one before
  // How fine the monolithic maps are made. What is finer is predicted.
  double monolithic_to_mm = 2;  ///< with our engine, all scans
  double stock_to_mm = 8;       ///< with stock, all scans
  double stock_part_to_mm = 2;  ///< with stock, some scans
  std::size_t stock_part_scans = 2;
};

struct ScanSet {
  std::string name;
  std::filesystem::path log;
  std::size_t scans = 0;
};

/// Runs experiment VI-A and says what it is doing. Rows of the single runs (`runsCsvHeader()`) go to
/// `runs_csv` as they come, so that an experiment that is stopped is not lost: what is `known` is not run
/// again.
///
/// Memory is guarded by estimate: a monolithic map that would take more than half of the memory that is
/// available is predicted, as if it were too fine.
[[nodiscard]] ViAResults runViA(const ViAOptions& options, const std::vector<ScanSet>& sets,
                                const KnownRuns& known, const std::function<void(const std::string&)>& say,
                                const std::function<void(const std::string&)>& runs_csv);

}  // namespace hoctomap
