// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "TableRelief.h"
#include "Vessels.h"

namespace hoctomap {

class ScanBlocks;

/// The points over a table's outline that are at most `certainHeight` above or below its plane, ascending;
/// those of objects found before are left out.
[[nodiscard]] std::vector<Candidate> pointsNearTable(const ScanBlocks& scan, const TableSurface& table,
                                                     const std::vector<bool>& in_object,
                                                     const TabletopSegmentationConfig& config);

/// The things that rise so little above the table that its noise would hide them: connected regions that
/// stand, on average over a few pixels each, above the table around them, and end at a step. Bends of the
/// table have no such rim.
/// @param near        see `pointsNearTable`
/// @param candidates  points off the table's plane; those that are not in `near` rise for certain
[[nodiscard]] std::vector<Cluster> thinThings(const Measurement& z, const TableRelief& relief,
                                              std::span<const Candidate> near,
                                              std::span<const Candidate> candidates,
                                              const TabletopSegmentationConfig& config);

}  // namespace hoctomap
