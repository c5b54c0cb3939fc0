// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hoctomap/config/Settings.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "identity/CrowdedScene.h"
#include "segmentation/Score.h"

namespace hoctomap {

/// In which order the scans of a log are integrated.
enum class ScanOrder { forward, reverse, shuffled };
[[nodiscard]] std::string toString(ScanOrder order);

/// The scans in another order, with the numbers and stamps of the places they come to. `seed` shuffles.
[[nodiscard]] std::vector<Measurement> reordered(std::vector<Measurement> scans, ScanOrder order,
                                                 std::uint64_t seed);

/// What became of a log: the objects of its map.
struct MappedObject {
  NodeId id;
  Eigen::Vector3d centroid;  ///< m, world, of its occupied voxels
  PointCloud world_voxels;
};

struct MappedLog {
  std::vector<MappedObject> objects;
  std::size_t tables = 0;
  std::vector<std::string> events;  ///< of objects: all but `updated`
};

/// Maps the scans as `build` would.
[[nodiscard]] MappedLog mapScans(const std::vector<Measurement>& scans, const Settings& settings);

/// Scans of a scene, and the surface that they show of its objects.
struct SeenScene {
  std::vector<Measurement> scans;
  std::vector<GreyImage> labels;      ///< of every scan; as `scoreSegmentation` wants the truth
  PointCloud world_surface;           ///< one point every 4 mm
  std::vector<std::uint16_t> object;  ///< of every point, from 0
  std::size_t objects = 0;
};
[[nodiscard]] SeenScene see(const CrowdedScene& scene);

/// The overlap of segments and objects in single views, their mean.
[[nodiscard]] SegmentationScore scoreViews(const SeenScene& scene, const Segmentation& segmentation);

/// Whether every object is one node: the overlap of nodes and objects on the surface that was seen, one node
/// matched to one object. A point belongs to the node that has the nearest voxel within 8 mm.
[[nodiscard]] SegmentationScore scoreIdentity(const MappedLog& map, const SeenScene& truth);

/// How many objects of `a` have one of `b` within `distance` metres, matched one to one, nearest first.
[[nodiscard]] std::size_t matchedObjects(const MappedLog& a, const MappedLog& b, double distance);

}  // namespace hoctomap
