// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "BlockView.h"
#include "RayBatch.h"
#include "RayClip.h"
#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::engine {

/// Memory that an update needs, kept for the next one: fresh memory costs far more time than used memory.
struct Scratch {
  VoxelBits free;
  VoxelBits occupied;
};

/// The beams of a scan as octomap takes them: cut at the maximum range.
class ScanBeams {
 public:
  ScanBeams(const VoxelGrid& grid, const Beams& beams);

  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] const Eigen::Vector3f& origin() const { return beams_.origin; }
  /// Keys that the scan may change, but for the strays.
  [[nodiscard]] const KeyBox& box() const { return box_; }
  /// Free voxels outside `box()`. At the end of the key range octomap's keys wrap to the other end.
  [[nodiscard]] const std::vector<Key>& strays() const { return strays_; }
  /// Endpoints that no key can address.
  [[nodiscard]] std::size_t beyondKeyRange() const { return beyond_key_range_; }
  /// Whether beams may leave that box.
  [[nodiscard]] bool bounded() const { return beams_.bounds.has_value(); }
  [[nodiscard]] const Beams& beams() const { return beams_; }

  /// True if `end` is an endpoint that becomes occupied, not a point on a beam that goes on.
  [[nodiscard]] bool isTooLong(const Eigen::Vector3f& end) const {
    return beams_.max_range >= 0.0 && norm(end - beams_.origin) > beams_.max_range;
  }
  [[nodiscard]] Eigen::Vector3f cut(const Eigen::Vector3f& end) const;

 private:
  // As octomap, with its order of operations: they decide the last bit of the new end.
  [[nodiscard]] static double norm(const Eigen::Vector3f& v) {
    return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
  }

  [[nodiscard]] bool allAddressable() const;
  void findOddities(const KeyBox& reach, const KeyBox& bounds);

  const VoxelGrid& grid_;
  const Beams& beams_;
  KeyBox box_;
  std::vector<Key> strays_;
  std::size_t beyond_key_range_ = 0;
};

/// Collects the voxels of a scan that lie in a box.
class ScanMarks {
 public:
  /// @param scratch empty, and left empty at the end.
  ScanMarks(const ScanBeams& scan, const KeyBox& box, bool bounded, bool best_instructions, Scratch& scratch);
  ScanMarks(const ScanMarks&) = delete;
  ScanMarks& operator=(const ScanMarks&) = delete;
  ScanMarks(ScanMarks&&) = delete;
  ScanMarks& operator=(ScanMarks&&) = delete;
  ~ScanMarks();

  void addHits(std::span<const Eigen::Vector3f> points);
  void addPassing(std::span<const Eigen::Vector3f> points);
  void addFree(const Key& key) { scratch_.free.mark(frame_.localCode(key)); }
  /// To be called once after the last point.
  void finish();

  /// Adds what another share of the scan marked in the same box.
  void unite(const ScanMarks& other);

  /// The blocks in the order of the octree.
  [[nodiscard]] std::vector<BlockMarks> blocks() const;

 private:
  template <class Before>
  void addSpread(std::span<const Eigen::Vector3f> points, Before&& before);
  void addRays(const std::array<Eigen::Vector3f, kLanes>& ends, std::size_t count);
  void addSpecial(const Eigen::Vector3f& end);

  const ScanBeams& scan_;
  KeyBox box_;
  bool bounded_;
  BlockFrame frame_;
  Scratch& scratch_;
  std::optional<RayFan> fan_;  ///< none if the origin lies beyond the key range
  RayCaster caster_;
  PrepareRays prepare_;
  RayMarker marker_;
};

}  // namespace hoctomap::engine
