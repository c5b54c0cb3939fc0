// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "hoctomap/octree/ScanUpdate.h"

namespace hoctomap {

/// One call of a `ScanUpdate`, with its own copy of the points.
struct RecordedUpdate {
  std::size_t tree = 0;  ///< number of the tree, in order of first use
  PointCloud hits;
  PointCloud passing;
  Beams beams;  ///< without the points

  /// The beams as they were given; valid as long as this record.
  [[nodiscard]] Beams view() const;
};

/// What the nodes of one resolution get while a hierarchy is mapped.
struct BeamRecord {
  std::vector<RecordedUpdate> updates;
  std::size_t trees = 0;
};

/// An update engine that hands all calls on to another one and records those for trees of `resolution`.
/// @param record must outlive the engine
[[nodiscard]] std::unique_ptr<ScanUpdate> makeBeamRecorder(std::unique_ptr<ScanUpdate> engine,
                                                           double resolution, BeamRecord& record);

}  // namespace hoctomap
