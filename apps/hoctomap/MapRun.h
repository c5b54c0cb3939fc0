// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "MemoryBudget.h"
#include "MotionLedger.h"
#include "Progress.h"
#include "RunLog.h"
#include "RunSummary.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/PipeSource.h"
#include "hoctomap/mapping/HierarchyMapper.h"
#include "hoctomap/mapping/ScanPipeline.h"

namespace hoctomap {

/// The loop of `build`: scans from the source into the mapper, the map into its directory.
class MapRun {
 public:
  struct Options {
    std::string input;                 ///< what the logs and events are known by in the map
    std::uint64_t first_scan = 0;      ///< the first one that is not in the map yet
    double last_stamp = 0.0;           ///< s, of the one before
    std::uint64_t mapped_scans = 0;    ///< in the map already
    std::uint64_t skipped_scans = 0;   ///< passed over before that
    std::uint64_t snapshot_every = 0;  ///< scans of the log; 0: no snapshots
  };

  MapRun(const Settings& settings, HierarchyMapper& mapper, MapDirectory& directory, RunLog& log,
         Options options, MotionLedger& motions);

  /// Runs to the end of the source, or until a signal asks to stop. Commits every `checkpoint_scans` scans
  /// and at the end.
  void run(PipeSource& source, Progress& progress);

  [[nodiscard]] const RunSummary& summary() const { return summary_; }

 private:
  void integrate(const Measurement& z, PreparedScan prepared, double read_seconds);
  void integrate(const ObjectMotion& motion, std::uint64_t scan);
  void checkLimits(const UpdateReport& report) const;
  void applyToldMotions(const Measurement& z);
  void finishScan(std::uint64_t scan);
  void finishLog();
  void commit(bool keep);

  const Settings& settings_;
  HierarchyMapper& mapper_;
  MapDirectory& directory_;
  RunLog& log_;
  Options options_;
  MotionLedger& motions_;
  std::uint64_t next_scan_;
  double last_stamp_ = 0.0;  ///< s, of the last scan that was mapped
  RunSummary summary_;
  MemoryBudget memory_;
};

}  // namespace hoctomap
