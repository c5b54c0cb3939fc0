// SPDX-License-Identifier: BSD-3-Clause
#include "MotionLedger.h"

#include <algorithm>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

MotionLedger::MotionLedger(std::vector<ToldMotion> told, const std::optional<MotionsTaken>& taken)
    : left_(std::move(told)), taken_(taken) {
  if (!taken_) return;
  met_again_ = taken_->after_scan;
  for (const ToldMotion& motion : takeDue(taken_->scan, taken_->time)) {
    if (taken_->told_sha256 == taken->told_sha256) continue;
    throw InputError("--events: line " + std::to_string(motion.line) + " or one before it is for scan " +
                     std::to_string(taken_->scan) +
                     " or earlier, which is in the map; what has been told of it cannot be changed");
  }
  if (taken_->told_sha256 != taken->told_sha256) {
    throw InputError("--events: the map was told of movements before scan " +
                     std::to_string(taken_->scan + 1) + " that are missing now");
  }
}

std::vector<ToldMotion> MotionLedger::takeDue(std::uint64_t scan, double stamp) {
  const auto later = std::stable_partition(
      left_.begin(), left_.end(), [&](const ToldMotion& motion) { return motion.isDue(scan, stamp); });
  std::vector<ToldMotion> due(std::make_move_iterator(left_.begin()), std::make_move_iterator(later));
  left_.erase(left_.begin(), later);
  past_.insert(past_.end(), due.begin(), due.end());
  std::stable_sort(past_.begin(), past_.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  const double latest = taken_ ? std::max(taken_->time, stamp) : stamp;
  const std::uint64_t after_scan = taken_ ? taken_->after_scan : 0;
  taken_ = MotionsTaken{scan, latest, after_scan, toldHash()};
  return due;
}

bool MotionLedger::takeFromLog() {
  if (met_again_ > 0) {
    --met_again_;
    return false;
  }
  if (taken_) ++taken_->after_scan;  // before the first scan there is nothing that could move
  return true;
}

void MotionLedger::finishScan() {
  met_again_ = 0;
  if (taken_) taken_->after_scan = 0;
}

std::string MotionLedger::toldHash() const {
  if (past_.empty()) return {};
  std::string rows;
  for (const ToldMotion& motion : past_) rows += motion.text + '\n';
  return sha256Hex(rows);
}

}  // namespace hoctomap
