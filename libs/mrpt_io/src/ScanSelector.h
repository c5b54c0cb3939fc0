// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "hoctomap/io/LogReadOptions.h"

namespace hoctomap {

/// Numbers the scans of all logs and says which are taken: those from `start` to `end` of the chosen sensors,
/// every n-th of them, perhaps a sample of those. Not chosen is not skipped.
class ScanSelector {
 public:
  /// @param chosen  scans that come without a sample
  ScanSelector(const LogReadOptions& options, std::uint64_t chosen) : options_(options), chosen_(chosen) {}

  /// Counts one more scan; whether it is taken.
  bool take(const std::string& sensor);

  /// Number of the scan that comes next.
  [[nodiscard]] std::uint64_t nextScan() const { return next_scan_; }
  /// Whether messages standing before the next scan belong to this run.
  [[nodiscard]] bool started() const {
    return next_scan_ >= options_.start && next_scan_ >= options_.resume_at;
  }
  /// Whether no further scan will be taken.
  [[nodiscard]] bool ended() const { return options_.end && next_scan_ >= *options_.end; }

 private:
  [[nodiscard]] bool sampled(std::uint64_t number) const;

  const LogReadOptions& options_;
  std::uint64_t chosen_;
  std::uint64_t next_scan_ = 0;
  std::uint64_t candidates_ = 0;
};

}  // namespace hoctomap
