// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "changes/ChangeScript.h"
#include "hoctomap/config/Settings.h"

namespace hoctomap {

/// Changes reported and true, one by one. A moved object that is reported as removed and created is one
/// change missed and two false alarms.
struct ChangeCounts {
  int right = 0;
  int false_alarms = 0;
  int missed = 0;

  void operator+=(const ChangeCounts& other);
  [[nodiscard]] double precision() const;
  [[nodiscard]] double recall() const;
};

/// How well a recovered motion fits the true one.
struct MotionError {
  std::string solid;
  double shift = 0.0;  ///< m, of the solid's centroid
  double turn = 0.0;   ///< rad; of boxes, which may be turned by a half; 0 for others
};

/// A probability of existence of the ledger, and whether the object was there.
struct ExistenceCheck {
  double probability = 0.0;
  bool exists = false;
};

struct ChangeResult {
  std::string name;
  ChangeCounts counts;
  std::vector<std::string> mistakes;  ///< one sentence each
  std::vector<MotionError> motions;
  std::vector<ExistenceCheck> existence;
};

/// Maps a script with these settings, as `hoctomap build` would its log, and compares with the truth.
[[nodiscard]] ChangeResult runChangeScript(const ChangeScript& script, const Settings& settings);

}  // namespace hoctomap
