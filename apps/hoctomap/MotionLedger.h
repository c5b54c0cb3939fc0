// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/MotionFile.h"

namespace hoctomap {

/// The movements of a run (Section III-D), told by `--events` or found in the log: each is applied once,
/// however often the run is stopped and continued.
class MotionLedger {
 public:
  /// @param told  all that the user tells  @param taken  what the map holds of it already
  /// @throws InputError if the user now tells something else of scans that are in the map.
  MotionLedger(std::vector<ToldMotion> told, const std::optional<MotionsTaken>& taken);

  /// The told motions to apply before this scan is integrated, in order of the file.
  [[nodiscard]] std::vector<ToldMotion> takeDue(std::uint64_t scan, double stamp);
  /// Whether the next motion of the log is to be applied: a continued run meets again those that stand
  /// between the last scan of the map and the next one.
  [[nodiscard]] bool takeFromLog();
  /// The map holds a scan more, mapped or skipped.
  void finishScan();

  /// For the map; nothing if there is nothing to remember.
  [[nodiscard]] const std::optional<MotionsTaken>& taken() const { return taken_; }
  /// Told motions that no scan was due for.
  [[nodiscard]] const std::vector<ToldMotion>& left() const { return left_; }

 private:
  [[nodiscard]] std::string toldHash() const;

  std::vector<ToldMotion> past_;  ///< in order of the file
  std::vector<ToldMotion> left_;
  std::optional<MotionsTaken> taken_;
  std::uint64_t met_again_ = 0;  ///< motions of the log that are in the map and are still to come
};

}  // namespace hoctomap
