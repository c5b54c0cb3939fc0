// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hoctomap/geometry/Pose.h"
#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/hierarchy/MapNode.h"
#include "hoctomap/hierarchy/NodeId.h"
#include "hoctomap/mapping/StillSensor.h"
#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {

/// Version of the map directory's format that this library writes (docs/map-format.md).
inline constexpr int kMapFormatVersion = 1;

/// A file of the map, as the manifest vouches for it.
struct FileRecord {
  std::string path;         ///< relative to the map directory, with `/`
  std::uint64_t bytes = 0;  ///< size; of a CSV file: how much of it belongs to the map
  std::string sha256;       ///< of these bytes, lower-case hexadecimal
  bool operator==(const FileRecord&) const = default;
};

/// A node as the manifest describes it: everything but the voxels.
struct NodeRecord {
  NodeId id;
  Label label;
  std::optional<NodeId> parent;  ///< none for the root
  std::vector<NodeId> children;  ///< ascending
  Pose parent_T_node;            ///< exact
  Pose world_T_node;
  double resolution = 0.0;          ///< m, exact (the header of a stock `.ot` rounds it)
  double existence = 0.5;           ///< P(n | z_1:t), in (0, 1)
  double existence_log_odds = 0.0;  ///< the same, exact
  /// The node's box in its frame: occupied voxels padded by one voxel; all zero without any.
  Eigen::Vector3d box_center = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_half_extents = Eigen::Vector3d::Zero();
  VoxelCounts voxels;
  std::uint64_t memory_bytes = 0;  ///< octomap's memoryUsage()
  std::uint64_t first_scan = 0;
  std::uint64_t last_scan = 0;
  std::uint64_t version = 0;  ///< names the files
  std::uint64_t edition = 0;  ///< the same, of nodes whose octree was edited by hand; 0: never
  PieceVotes votes;
  Confirmation confirmation;
  OccupancyModel occupancy;  ///< sensor model (a `.ot` file forgets it)
  FileRecord ot;
  FileRecord bt;
  std::optional<std::uint64_t> removed_scan;  ///< only of removed nodes
};

/// Which movements of the input (Section III-D) a state holds already, for a run that goes on.
struct MotionsTaken {
  std::uint64_t scan = 0;        ///< told motions that were due by this scan, the last one mapped ...
  double time = 0.0;             ///< ... or by this time, the latest of a mapped scan, are in the map
  std::uint64_t after_scan = 0;  ///< movements of the log that came after its scan `Manifest::scans` - 1
  std::string told_sha256;       ///< what the caller knows the told ones by
  bool operator==(const MotionsTaken&) const = default;
};

/// `hierarchy.yaml`: names the files of one consistent map.
struct Manifest {
  int format_version = kMapFormatVersion;
  std::string generator;    ///< program and version
  std::uint64_t scans = 0;  ///< scans of the log taken in, skipped ones included: the index of the next
  double last_stamp = 0.0;  ///< s since 1970, of the last of them
  std::uint64_t mapped_scans = 0;   ///< of them, those that were of use ...
  std::uint64_t skipped_scans = 0;  ///< ... and those that were not; the rest was not chosen
  std::uint64_t edits = 0;          ///< by hand (`hoctomap edit`) since the first scan
  std::string config_sha256;        ///< of `config.ini`
  std::string input;  ///< what the caller knows the log by, in order to notice another one; may be empty
  NodeId next_id{1};  ///< id of the next new node
  FileRecord config;
  FileRecord events;
  /// The part of `events` that a run which goes on with the log keeps, if the end of the log added some.
  std::optional<FileRecord> events_before_end;
  FileRecord existence;
  std::optional<FileRecord> scan_table;  ///< `scans.csv`; maps of earlier versions have none
  std::optional<FileRecord> seams;       ///< votes on where objects meet (SeamVotes), for a run that goes on
  std::optional<FileRecord> index;       ///< the nodes once more, for quick reading (docs/decisions/0057)
  std::optional<FileRecord> scene;
  std::optional<StillSensor> sensor;  ///< of the last scan, for a run that goes on
  std::optional<MotionsTaken> motions;
  std::vector<NodeRecord> nodes;    ///< parents before children, siblings by id
  std::vector<NodeRecord> removed;  ///< by id; their files stay in `nodes/`
  std::vector<NodeRecord> waiting;  ///< for confirmation, by id: part of the map only for a run that goes on
  /// Not in the file: nodes of a kept state that entered `nodes` when it was read, as at the end of a log.
  std::vector<NodeId> let_in_at_end;

  /// Every file the manifest names.
  [[nodiscard]] std::vector<FileRecord> files() const;
  /// @returns null if there is no such node in the tree.
  [[nodiscard]] const NodeRecord* find(NodeId id) const;
};

/// The manifest's text. Same manifest, same bytes.
[[nodiscard]] std::string toYaml(const Manifest& manifest);

/// Reads and validates a manifest. `name` stands for the file in messages.
///
/// Guarantees of what is returned: exactly one root, with id 0, at the world's origin; every parent is there;
/// `children` mirrors `parent`; no cycle; ids unique; existence inside (0, 1); poses orthonormal; numbers
/// finite; file names relative and inside the directory.
/// @throws MapError naming file, node and key; LimitError beyond 10^5 nodes or a depth of 64.
[[nodiscard]] Manifest parseManifest(const std::string& text, const std::string& name);

/// The manifest of a map directory, without its node files. `at_scan`: the newest kept snapshot (or the map
/// itself) that has taken in no scan after this one, as a run that ended there would have left it.
/// @throws MapError if there is none; FileError if it cannot be read.
[[nodiscard]] Manifest readManifest(const std::filesystem::path& directory,
                                    std::optional<std::uint64_t> at_scan = std::nullopt);

}  // namespace hoctomap
