// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "MarkedReach.h"
#include "ScanBeams.h"

namespace hoctomap::engine {

/// True if the beams are so many, so long and so close together that most of the voxels that a beam meets
/// have been met by others: looked up in a sample.
bool isDense(const ScanBeams& scan, std::span<const Eigen::Vector3f> points);

/// False for a beam that ends at the origin, or nowhere: it marks nothing. @param way from the origin to its
/// end.
bool hasDirection(const Eigen::Vector3f& way);

/// A dense scan is marked in rounds: few beams in all directions first, then those between them, which may
/// start where all is marked.
inline constexpr std::array<std::uint32_t, 3> kRounds{2, 8, 32};  ///< so many of 32 beams up to each round

/// The round of a beam, by its number in the scan: as if drawn, so that the first rounds have some beams of
/// every direction however the scan is ordered.
constexpr std::size_t roundOf(std::size_t beam) {
  const std::uint32_t drawn = (static_cast<std::uint32_t>(beam) * 0x9E37'79B1U) >> 27U;
  std::size_t round = 0;
  while (drawn >= kRounds[round]) ++round;
  return round;
}

}  // namespace hoctomap::engine
