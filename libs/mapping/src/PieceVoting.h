// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "hoctomap/existence/InverseExistenceModel.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A segment of the scan and the node that took it.
struct TakenSegment {
  NodeId node;
  const PointCloud* world_points = nullptr;
  std::optional<NodeId>
      joined_with{};  ///< the node that took most of the segment, of which this is a part only
};

/// Takes one scan's vote on whether `piece` is a node of its own or a piece of another one of its label: an
/// occluder, or a gap in the data, can make one object look like two until a better view shows it whole.
/// A scan votes *apart* when the piece took a segment of its own, and *joined* when it is seen, took none,
/// and most points in its box are those of one other node. A vote of scans decides because a single view can
/// join what merely touches. The smaller the piece is beside the other, the fewer votes it takes
/// (docs/decisions/0006).
/// @return the node that it is a piece of, if that is settled by now
std::optional<NodeId> voteOnPiece(MapHierarchy& hierarchy, NodeId piece, const Evidence& evidence,
                                  std::span<const TakenSegment> taken);

}  // namespace hoctomap
