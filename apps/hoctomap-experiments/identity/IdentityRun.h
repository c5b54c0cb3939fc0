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
  std::vector<std::string> names;  ///< of the objects
};
[[nodiscard]] SeenScene see(const CrowdedScene& scene);

/// The overlap of segments and objects in single views, their mean.
[[nodiscard]] SegmentationScore scoreViews(const SeenScene& scene, const Segmentation& segmentation);

/// Whether every object is one node: the overlap of nodes and objects on the surface that was seen, one node
/// matched to one object. A point belongs to the node that has the nearest voxel within 8 mm.
[[nodiscard]] SegmentationScore scoreIdentity(const MappedLog& map, const SeenScene& truth);

/// What became of the surface of one object that was seen, in shares.
struct ObjectFate {
  std::string name;
  double points = 0.0;  ///< of its surface
  double found = 0.0;   ///< in the node that is matched with it
  double in_other_half =
      0.0;                  ///< in nodes that hold more of it than of any other object, but are not matched
  double in_another = 0.0;  ///< in nodes of other objects
  double nowhere = 0.0;     ///< in no node
  std::string joined_with;  ///< object that has the node which holds most of this one, if another
};
[[nodiscard]] std::vector<ObjectFate> objectFates(const MappedLog& map, const SeenScene& truth);

/// How many objects of `a` have one of `b` within `distance` metres, matched one to one, nearest first.
[[nodiscard]] std::size_t matchedObjects(const MappedLog& a, const MappedLog& b, double distance);

}  // namespace hoctomap
