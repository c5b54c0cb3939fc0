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
/// start where all is marked. Of every 32 beams so many are done by the end of each round.
inline constexpr std::array<std::size_t, 3> kRounds{2, 8, 32};

/// Calls `visit(beam)` for the beams of a round, by their numbers: of every 32 in a row others, as if drawn,
/// so that the first rounds have some beams of every direction however the scan is ordered.
template <class Visit>
void forEachOfRound(std::size_t round, std::size_t beams, Visit&& visit) {
  constexpr std::size_t kGroup = kRounds.back();
  for (std::size_t group = 0; group * kGroup < beams; ++group) {
    const std::size_t drawn = (static_cast<std::uint32_t>(group) * 0x9E37'79B1U) >> 27U;
    for (std::size_t i = round == 0 ? 0 : kRounds[round - 1]; i < kRounds[round]; ++i) {
      constexpr std::size_t kApart = 13;  // no divisor in common with the group's size: each is met once
      const std::size_t beam = group * kGroup + (drawn + i * kApart) % kGroup;
      if (beam < beams) visit(beam);
    }
  }
}

}  // namespace hoctomap::engine
