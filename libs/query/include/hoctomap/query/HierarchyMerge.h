// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/LabelProfile.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {

/// One of the maps that are merged.
struct MergePart {
  const MapHierarchy& hierarchy;  ///< with the nodes that wait for confirmation
  Pose world_T_map;               ///< its world in that of the result
  std::uint64_t scans = 0;        ///< of its log; in the result the scans of the parts follow on one another
  double last_stamp = 0.0;        ///< s since 1970
  std::string name;               ///< for the events
};

struct MergeConfig {
  double near = 0.006;    ///< m; surfaces nearer than this, plus a voxel, are one (as in DiffConfig)
  double overlap = 0.25;  ///< share of the smaller surface that must lie on the other to be the same object
  std::uint64_t confirm_scans = 2;  ///< that confirm a node which waits, in all parts together
};

struct MergedMaps {
  MapHierarchy hierarchy;
  /// One a part, at its last scan: `created` for nodes that are new, `updated` for those that were added to
  /// another one, `merged` for nodes of earlier parts that this part shows to be one; their p_measurement is
  /// the existence that came in.
  std::vector<UpdateReport> reports;
  std::vector<RemovedNode> removed;  ///< the nodes of the `merged` events
  std::uint64_t scans = 0;           ///< of all parts
};

/// Merges maps of one place, in their order (docs/decisions/0042).
///
/// Nodes are the same object as f_A would have it, if they have the same label and their boxes intersect, and
/// if their surfaces overlap. They become one, in the frame and with the id of the first: occupancy is added
/// in log-odds, existence by Eq. 8. All other nodes are taken over in frames of their own. A node that waits
/// for confirmation in one part is confirmed by one of another part that is the same; else it waits in the
/// result, too.
/// @throws std::invalid_argument without a part; std::out_of_range if a label has no profile
[[nodiscard]] MergedMaps mergeMaps(std::span<const MergePart> parts, const LabelProfiles& profiles,
                                   const MergeConfig& config = {});

}  // namespace hoctomap
