// SPDX-License-Identifier: BSD-3-Clause
#include "RunSummary.h"

#include <iomanip>
#include <sstream>

#include "TextTable.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

std::string percentText(double share) {
  return fixedText(100.0 * share, 0) + " %";
}

/// Stages in the order of the work.
std::string stageTable(const std::map<std::string, double>& seconds) {
  double sum = 0.0;
  for (const auto& [stage, spent] : seconds) sum += spent;
  TextTable table({"stage", "seconds", "share"});
  for (const char* stage : {"read", "segment", "associate", "update", "existence", "write"}) {
    const auto found = seconds.find(stage);
    if (found == seconds.end()) continue;
    table.add({stage, fixedText(found->second, 2), percentText(sum > 0.0 ? found->second / sum : 0.0)});
  }
  return table.text();
}

}  // namespace

std::string labelTable(const Manifest& manifest) {
  struct Sum {
    std::uint64_t nodes = 0;
    std::uint64_t occupied = 0;
    std::uint64_t free = 0;
    std::uint64_t memory = 0;
  };
  std::map<std::string, Sum> sums;
  Sum all;
  for (const NodeRecord& node : manifest.nodes) {
    for (Sum* sum : {&sums[node.label.name], &all}) {
      ++sum->nodes;
      sum->occupied += node.voxels.occupied;
      sum->free += node.voxels.free;
      sum->memory += node.memory_bytes;
    }
  }
  TextTable table({"label", "nodes", "occupied", "free voxels", "memory [MB]"});
  const auto add = [&table](const std::string& name, const Sum& sum) {
    table.add({name, std::to_string(sum.nodes), std::to_string(sum.occupied), std::to_string(sum.free),
               fixedText(1e-6 * static_cast<double>(sum.memory), 1)});
  };
  for (const auto& [label, sum] : sums) add(escapedText(label, 60), sum);
  add("all", all);
  return table.text();
}

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
  if (!seconds_.empty()) out << "\n" << stageTable(seconds_);
  return out.str();
}

}  // namespace hoctomap
