// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "RayBatch.h"

namespace hoctomap::engine {

/// Marks the free cells of rays, many at a time: a batch is prepared, ordered by length, and marked in
/// lockstep.
class RayMarker {
 public:
  RayMarker(const RayFan& fan, VoxelBits& bits, InstructionSet set);

  /// Marks the cells before `end`, now or by the time of `finish`. The cells that the ray visits before so
  /// many steps along an axis may be left out.
  void add(const Eigen::Vector3f& end, std::size_t skip_axis = 0, int skip_steps = 0);

  void finish();

  /// The ends of rays that need the exact path; whole once `finish` has been called.
  [[nodiscard]] std::span<const Eigen::Vector3f> special() const { return special_; }

 private:
  using Order = std::array<std::uint16_t, kBatch>;  ///< rays of a batch

  void markBatch();
  void markGroup(const std::uint16_t* rays);
  std::size_t orderByLength(Order& order);
  void addSpecial(std::size_t ray);

  const RayFan& fan_;
  VoxelBits& bits_;
  Preparation preparation_;
  /// Marks the cells of so many rays. False if two of the times are too close to tell
  /// their order without exact times: then some cells are not marked.
  bool (*mark_)(const RayBatch&, const std::uint16_t* rays, BlockBits* words, std::uint8_t* pages);
  std::size_t lanes_;
  bool fixed_;  ///< whether `markFixed` comes first
  RayEnds ends_;
  RayBatch batch_;
  std::vector<Eigen::Vector3f> special_;
};

}  // namespace hoctomap::engine
