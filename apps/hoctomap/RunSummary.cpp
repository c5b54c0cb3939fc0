// SPDX-License-Identifier: BSD-3-Clause
#include "RunSummary.h"

#include <iomanip>
#include <sstream>

namespace hoctomap {

void RunSummary::addUsed(const Measurement& z) {
  ++used_;
  empty_ += z.world_points.empty() ? 1U : 0U;
  dropped_points_ += z.dropped_points;
}

void RunSummary::addReport(const UpdateReport& report) {
  beyond_key_range_ += report.beyond_key_range;
  addSeconds("segment", report.seconds.segment);
  addSeconds("associate", report.seconds.associate);
  addSeconds("update", report.seconds.update);
  addSeconds("existence", report.seconds.existence);
}

std::uint64_t RunSummary::skipped() const {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : skipped_) sum += count;
  return sum;
}

bool RunSummary::skippedMoreThan(double share) const {
  return static_cast<double>(skippedInAll()) > share * static_cast<double>(mappedInAll() + skippedInAll());
}

std::string RunSummary::text() const {
  std::ostringstream out;
  out << "scans      " << used_ << " used";
  if (empty_ > 0) out << " (" << empty_ << " without points)";
  out << ", " << skipped() << " skipped\n";
  for (const auto& [reason, count] : skipped_) out << "           " << count << " x " << reason << "\n";
  if (dropped_points_ > 0) out << "points     " << dropped_points_ << " unusable points dropped\n";
  if (beyond_key_range_ > 0) {
    out << "points     " << beyond_key_range_ << " endpoints beyond what an octree can address dropped\n";
  }
  if (!seconds_.empty()) {
    out << "seconds   " << std::fixed << std::setprecision(2);
    for (const auto& [stage, seconds] : seconds_) out << " " << stage << " " << seconds;
    out << "\n";
  }
  return out.str();
}

}  // namespace hoctomap
