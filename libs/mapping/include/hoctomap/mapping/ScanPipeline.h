// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "hoctomap/mapping/HierarchyMapper.h"
#include "hoctomap/mapping/MeasurementSource.h"

namespace hoctomap {

/// The items of a source, with the next scan being prepared while its predecessor is integrated. What does
/// not depend on the map is computed ahead, so the result is the same as without.
///
/// Usage:
///   ScanPipeline pipeline(source, mapper);
///   while (auto item = pipeline.next()) ... mapper.integrate(measurement, std::move(*item->prepared));
///
/// Guarantees:
///  1. items come in the order of the source, one is taken from it ahead;
///  2. the source is asked on the thread that calls next() only;
///  3. what the source or the preparation throws comes out of the call of next() that would have given the
///  item,
///     after all items before it;
///  4. with one thread (oneTBB's limit) nothing runs at the same time.
class ScanPipeline {
 public:
  struct Item {
    SourceItem item;
    std::optional<PreparedScan> prepared;  ///< of a measurement
    double read_seconds = 0.0;             ///< wall time that the source took
  };

  /// Both must outlive the pipeline. Preparation uses the strategies of `mapper` on another thread.
  ScanPipeline(MeasurementSource& source, const HierarchyMapper& mapper);
  /// Waits for the scan that is being prepared.
  ~ScanPipeline();
  ScanPipeline(const ScanPipeline&) = delete;
  ScanPipeline& operator=(const ScanPipeline&) = delete;

  /// The next item; nothing at the end.
  [[nodiscard]] std::optional<Item> next();

 private:
  struct Ahead;
  [[nodiscard]] std::unique_ptr<Ahead> fetch();

  MeasurementSource& source_;
  const HierarchyMapper& mapper_;
  std::unique_ptr<Ahead> ahead_;
  bool started_ = false;
};

}  // namespace hoctomap
