// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "Map.h"
#include "Measurements.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap::python {

/// The mapper as Python has it: numbers scans, keeps the reports for the map's files, and lets one thread in
/// at a time. All functions are called without the interpreter's lock, which the strategies may take.
class PyMapper {
 public:
  PyMapper(Settings settings, MappingStrategies strategies);

  [[nodiscard]] const Settings& settings() const { return settings_; }

  UpdateReport integrate(NumberedMeasurement& measurement);
  /// All of a source, the next scan being prepared while its predecessor is integrated.
  std::vector<UpdateReport> run(MeasurementSource& source);
  /// Gives `measurement` the next number if it has none.
  void number(NumberedMeasurement& measurement);
  UpdateReport move(NodeId node, const Pose& motion);
  UpdateReport finish();
  /// A copy of the map as it is.
  [[nodiscard]] std::shared_ptr<Map> map();
  void save(const std::filesystem::path& directory, bool overwrite);

 private:
  class Turn;
  UpdateReport integrate(const Measurement& z, PreparedScan prepared);
  const UpdateReport& keep(UpdateReport report);

  Settings settings_;
  HierarchyMapper mapper_;
  std::vector<UpdateReport> reports_;
  std::optional<UpdateReport> end_;
  std::shared_ptr<Map> map_;       ///< of `map()`, until something changes
  std::uint64_t next_number_ = 0;  ///< of scans that come
  std::uint64_t scans_ = 0;        ///< taken in: the last one's number + 1
  std::uint64_t mapped_ = 0;
  double last_stamp_ = 0.0;
  std::atomic<bool> busy_ = false;
  bool failed_ = false;
};

}  // namespace hoctomap::python
