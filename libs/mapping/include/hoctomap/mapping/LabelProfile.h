// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "hoctomap/existence/ExistenceFilter.h"
#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/octree/OccupancyModel.h"

namespace hoctomap {

enum class FrameChoice { world, pca };  ///< axes of a new node: the world's, or principal components (IV-A)
enum class Carve { own, scan };         ///< whose beams clear a node's free space: its own segments', or all
enum class Grazing { clear, spare };    ///< whether beams clear voxels of the surface that they end on

/// How nodes of one label are mapped (Section III-E: "adapt certain map properties").
struct LabelProfile {
  double resolution = 0.05;  ///< m
  double max_range = -1.0;   ///< m; negative: that of the sensor
  double max_memory = -1.0;  ///< MB of a node's octree with the update under way; negative: no limit
  OccupancyModel occupancy;
  FrameChoice frame = FrameChoice::pca;
  Carve carve = Carve::own;
  Grazing grazing = Grazing::clear;
  ExistenceParameters existence;
  bool existence_enabled = true;  ///< false: nodes of this label are never removed for lack of evidence
};

using LabelProfiles = std::map<Label, LabelProfile>;

}  // namespace hoctomap
