// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "hoctomap/config/Settings.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

/// A segment of a scan as the mapper has it after labelling.
struct PartOfScan {
  Label label;
  PointCloud world_points;
  Obb box;
};

/// What all stages are measured with: the scans of a log, and the map of all but the last.
class BenchmarkInput {
 public:
  explicit BenchmarkInput(std::filesystem::path log);

  [[nodiscard]] const std::filesystem::path& log() const { return log_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<Measurement>& scans() const { return scans_; }
  [[nodiscard]] const Measurement& lastScan() const { return scans_.back(); }
  [[nodiscard]] const MapHierarchy& map() const { return mapper_.hierarchy(); }
  [[nodiscard]] std::vector<PartOfScan> partsOfLastScan() const;

 private:
  std::filesystem::path log_;
  Settings settings_;
  std::vector<Measurement> scans_;
  HierarchyMapper mapper_;
};

// One a source file: registers the benchmarks of some stages. `input` must outlive them.
void registerInputStages(const BenchmarkInput& input);
void registerMappingStages(const BenchmarkInput& input);
void registerUpdate(const BenchmarkInput& input);
void registerCommit(const BenchmarkInput& input);

}  // namespace hoctomap
