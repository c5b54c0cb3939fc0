// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "hoctomap/io/Manifest.h"
#include "hoctomap/mapping/MeasurementSource.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {

/// What a run took in, for its summary and its exit code.
class RunSummary {
 public:
  /// Scans that a continued map holds already count for the exit code.
  explicit RunSummary(std::uint64_t mapped_before = 0, std::uint64_t skipped_before = 0)
      : mapped_before_(mapped_before), skipped_before_(skipped_before) {}

  void addSkipped(const SkippedScan& skipped) { ++skipped_[skipped.reason]; }
  void addUsed(const Measurement& z);
  void addReport(const UpdateReport& report);
  void addSeconds(const std::string& stage, double seconds) { seconds_[stage] += seconds; }

  [[nodiscard]] std::uint64_t used() const { return used_; }
  [[nodiscard]] std::uint64_t skipped() const;
  [[nodiscard]] std::uint64_t mappedInAll() const { return mapped_before_ + used_; }
  [[nodiscard]] std::uint64_t skippedInAll() const { return skipped_before_ + skipped(); }
  /// Whether more than `share` of the scans were skipped.
  [[nodiscard]] bool skippedMoreThan(double share) const;

  /// Lines about scans, points and time.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t mapped_before_ = 0;
  std::uint64_t skipped_before_ = 0;
  std::uint64_t used_ = 0;
  std::uint64_t empty_ = 0;
  std::uint64_t dropped_points_ = 0;
  std::uint64_t beyond_key_range_ = 0;
  std::map<std::string, std::uint64_t> skipped_;
  std::map<std::string, double> seconds_;
};

/// Nodes, voxels and memory of a map by label, as a table that ends with a newline.
[[nodiscard]] std::string labelTable(const Manifest& manifest);

}  // namespace hoctomap
