// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "BlockView.h"
#include "EndpointMarker.h"
#include "MarkedReach.h"
#include "RayClip.h"
#include "RayMarker.h"
#include "ScanBeams.h"

namespace hoctomap::engine {

/// Memory that an update needs, kept for the next one: fresh memory costs far more time than used memory.
struct Scratch {
  VoxelBits free;
  VoxelBits occupied;

  void keepAtMost(std::size_t pages) {
    free.keepAtMost(pages);
    occupied.keepAtMost(pages);
  }
};

/// Collects the voxels of a scan that lie in a box.
class ScanMarks {
 public:
  /// @param scratch empty, and left empty at the end.
  ScanMarks(const ScanBeams& scan, const KeyBox& box, bool bounded, InstructionSet set, Scratch& scratch);
  ScanMarks(const ScanMarks&) = delete;
  ScanMarks& operator=(const ScanMarks&) = delete;
  ScanMarks(ScanMarks&&) = delete;
  ScanMarks& operator=(ScanMarks&&) = delete;
  ~ScanMarks();

  void addHits(std::span<const Eigen::Vector3f> points);
  void addPassing(std::span<const Eigen::Vector3f> points);
  void addEndpoints(std::span<const Eigen::Vector3f> points);
  void addFree(const Key& key) { scratch_.free.mark(frame_.localCode(key)); }
  /// To be called once after the last point.
  void finish();

  /// Adds what another share of the scan marked in the same box.
  void unite(const ScanMarks& other);

  /// The blocks in the order of the octree.
  [[nodiscard]] std::vector<BlockMarks> blocks() const;

 private:
  void addBeams(std::span<const Eigen::Vector3f> points);
  void addExactly(const Eigen::Vector3f& end);

  const ScanBeams& scan_;
  KeyBox box_;
  bool bounded_;
  BlockFrame frame_;
  Scratch& scratch_;
  std::optional<RayFan> fan_;  ///< none if the origin lies beyond the key range
  RayCaster caster_;
  MarkEndpoints mark_endpoints_;
  std::optional<RayMarker> marker_;   ///< as `fan_`
  std::optional<MarkedReach> reach_;  ///< for large scans from inside the box
};

}  // namespace hoctomap::engine
