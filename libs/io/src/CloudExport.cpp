// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/CloudExport.h"

#include <bit>
#include <cstring>
#include <map>

#include "LabelColour.h"

namespace hoctomap {

namespace {

static_assert(std::endian::native == std::endian::little, "both formats are written as little endian");

struct VoxelPoint {
  Eigen::Vector3f world;
  std::array<std::uint8_t, 3> colour{};
  std::uint32_t label = 0;
  std::uint32_t node = 0;
  float probability = 0.F;
};

/// The labels of a map, in alphabetical order, with their numbers.
std::map<Label, std::uint32_t> labelNumbers(const MapHierarchy& hierarchy) {
  std::map<Label, std::uint32_t> numbers;
  for (const NodeId id : hierarchy.ids()) numbers.emplace(hierarchy.node(id).label(), 0);
  std::uint32_t next = 0;
  for (auto& [label, number] : numbers) number = next++;
  return numbers;
}

std::vector<VoxelPoint> pointsOf(const MapHierarchy& hierarchy,
                                 const std::map<Label, std::uint32_t>& numbers) {
  std::vector<VoxelPoint> points;
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    const Pose world_T_node = hierarchy.world_T_node(id);
    const PointCloud& voxels = node.map().occupiedVoxels();
    const PointCloud world = transformed(world_T_node, voxels);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      const auto* leaf = node.map().tree().search(voxels[i].x(), voxels[i].y(), voxels[i].z());
      points.push_back({world[i], colourOf(node.label()), numbers.at(node.label()), id.value,
                        static_cast<float>(leaf->getOccupancy())});
    }
  }
  return points;
}

/// `comment label 0 background`, a line a label
std::string labelLines(const std::map<Label, std::uint32_t>& numbers, const std::string& begin) {
  std::string lines;
  for (const auto& [label, number] : numbers)
    lines += begin + "label " + std::to_string(number) + " " + label.name + "\n";
  return lines;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string plyOf(const MapHierarchy& hierarchy) {
  const auto numbers = labelNumbers(hierarchy);
  const auto points = pointsOf(hierarchy, numbers);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment hoctomap: occupied voxels\n" +
                      labelLines(numbers, "comment ") + "element vertex " + std::to_string(points.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property int label\nproperty int node\nproperty float probability\nend_header\n";
  for (const VoxelPoint& p : points) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, p.world[axis]);
    append(bytes, p.colour);
    append(bytes, p.label);
    append(bytes, p.node);
    append(bytes, p.probability);
  }
  return bytes;
}

std::string pcdOf(const MapHierarchy& hierarchy) {
  const auto numbers = labelNumbers(hierarchy);
  const auto points = pointsOf(hierarchy, numbers);
  const std::string count = std::to_string(points.size());
  std::string bytes = "# .PCD v0.7 - hoctomap: occupied voxels\n" + labelLines(numbers, "# ") +
                      "VERSION 0.7\nFIELDS x y z rgb label node probability\nSIZE 4 4 4 4 4 4 4\n"
                      "TYPE F F F U U U F\nCOUNT 1 1 1 1 1 1 1\nWIDTH " +
                      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const VoxelPoint& p : points) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, p.world[axis]);
    append(bytes, std::uint32_t{p.colour[0]} << 16U | std::uint32_t{p.colour[1]} << 8U | p.colour[2]);
    append(bytes, p.label);
    append(bytes, p.node);
    append(bytes, p.probability);
  }
  return bytes;
}

}  // namespace hoctomap
