// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBuilder.h"

#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CText3D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace hoctomap {
namespace {

using mrpt::img::TColor;

/// Fig. 3 of the paper: objects cyan, tables magenta, the rest yellow.
TColor colorOf(const Label& label) {
  if (label == labels::object) return {0, 190, 205};
  if (label == labels::table) return {205, 40, 165};
  if (label == labels::background) return {235, 205, 70};
  return {120, 180, 90};
}

const std::array<Eigen::Vector3d, 6> kNormals{Eigen::Vector3d::UnitX(),  Eigen::Vector3d::UnitY(),
                                              Eigen::Vector3d::UnitZ(),  -Eigen::Vector3d::UnitX(),
                                              -Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()};

mrpt::math::TPoint3D point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

std::string titleOf(const MapNode& node) {
  std::array<char, 32> existence{};
  std::snprintf(existence.data(), existence.size(), "%.2f", node.existence());
  return std::to_string(node.id().value) + " " + node.label().name + " " + existence.data();
}

Eigen::AlignedBox3d paddedBox(const NodeMap& map) {
  Eigen::AlignedBox3d box = map.occupiedBox();
  const Eigen::Vector3d pad = Eigen::Vector3d::Constant(map.resolution());
  if (!box.isEmpty()) box = {box.min() - pad, box.max() + pad};
  return box;
}

mrpt::opengl::COctoMapVoxels::Ptr voxelsOf(const MapNode& node) {
  using mrpt::opengl::COctoMapVoxels;
  auto voxels = COctoMapVoxels::Create();
  const TColor color = colorOf(node.label());
  voxels->setColor_u8(color);
  voxels->setVisualizationMode(COctoMapVoxels::FIXED);
  voxels->enableLights(true);
  voxels->enableCubeTransparency(false);
  voxels->resizeVoxelSets(1);
  const octomap::OcTree& tree = node.map().tree();
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const mrpt::math::TPoint3Df center(static_cast<float>(leaf.getX()), static_cast<float>(leaf.getY()),
                                       static_cast<float>(leaf.getZ()));
    voxels->push_back_Voxel(0, COctoMapVoxels::TVoxel(center, leaf.getSize(), color));
  }
  const Eigen::AlignedBox3d box = paddedBox(node.map());
  if (!box.isEmpty()) voxels->setBoundingBox(point(box.min()), point(box.max()));
  return voxels;
}

/// Brightness of a face: soft light from above and aside, so that no side is black.
double shade(const Eigen::Vector3d& world_normal) {
  const Eigen::Vector3d to_light = Eigen::Vector3d(0.30, -0.50, 0.81).normalized();
  return 0.45 + 0.55 * (0.5 + 0.5 * world_normal.dot(to_light));
}

TColor shaded(const TColor& color, double brightness) {
  const auto part = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(value * brightness));
  };
  return {part(color.R), part(color.G), part(color.B)};
}

void addFace(mrpt::opengl::CSetOfTriangles& surface, const Eigen::Vector3d& center,
             const Eigen::Vector3d& normal, double half, const TColor& color) {
  const Eigen::Vector3d u(normal.y(), normal.z(), normal.x());
  const Eigen::Vector3d v = normal.cross(u);
  const auto corner = [&](double a, double b) {
    const Eigen::Vector3f p = (center + half * (normal + a * u + b * v)).cast<float>();
    return mrpt::math::TPoint3Df(p.x(), p.y(), p.z());
  };
  for (const double side : {1.0, -1.0}) {
    mrpt::opengl::TTriangle triangle(corner(-1, -1), corner(side, -side), corner(1, 1));
    triangle.setColor(color);
    triangle.computeNormals();
    surface.insertTriangle(triangle);
  }
}

mrpt::opengl::CSetOfTriangles::Ptr surfaceOf(const MapNode& node, const Pose& world_T_node) {
  auto surface = mrpt::opengl::CSetOfTriangles::Create();
  surface->enableLight(false);  // the colours are shaded already
  const octomap::OcTree& tree = node.map().tree();
  const double voxel = node.map().resolution();
  const Eigen::Matrix3d rotation = toIsometry(world_T_node).linear();
  for (const Eigen::Vector3d& normal : kNormals) {
    const TColor color = shaded(colorOf(node.label()), shade(rotation * normal));
    for (const Eigen::Vector3f& point : node.map().occupiedVoxels()) {
      const Eigen::Vector3d center = point.cast<double>();
      const Eigen::Vector3d beside = center + voxel * normal;
      const auto* neighbour = tree.search(beside.x(), beside.y(), beside.z());
      if (neighbour != nullptr && tree.isNodeOccupied(neighbour)) continue;
      addFace(*surface, center, normal, 0.5 * voxel, color);
    }
  }
  return surface;
}

mrpt::opengl::CBox::Ptr boxOf(const MapNode& node, const Eigen::AlignedBox3d& box) {
  const double width = 1.0;
  auto wireframe = mrpt::opengl::CBox::Create(point(box.min()), point(box.max()), true, width);
  wireframe->setColor_u8(colorOf(node.label()));
  return wireframe;
}

/// The title above the box, upright in the world as far as a fixed pose can be.
mrpt::opengl::CText3D::Ptr textOf(const MapNode& node, const Eigen::AlignedBox3d& box,
                                  const Pose& world_T_node) {
  const double height = std::clamp(0.12 * box.diagonal().norm(), 0.008, 0.1);
  auto text = mrpt::opengl::CText3D::Create(titleOf(node), "sans", static_cast<float>(height));
  text->setColor_u8(40, 40, 40);
  const Eigen::AlignedBox3d world_box = worldBounds({toIsometry(world_T_node), box});
  const Eigen::Vector3d top(world_box.min().x(), world_box.center().y(), world_box.max().z() + 0.5 * height);
  const Pose world_T_text(top.x(), top.y(), top.z(), 0.0, 0.0, 0.5 * M_PI);  // text stands: its y is world z
  text->setPose(-world_T_node + world_T_text);
  return text;
}

mrpt::opengl::CSetOfObjects::Ptr groupOf(const MapHierarchy& hierarchy, NodeId id, const SceneParts& parts) {
  const MapNode& node = hierarchy.node(id);
  auto group = mrpt::opengl::CSetOfObjects::Create();
  group->setName("node " + std::to_string(id.value) + " " + node.label().name);
  group->setPose(node.parent_T_node());
  if (parts.hidden.contains(node.label())) return group;
  if (parts.surface) {
    group->insert(surfaceOf(node, hierarchy.world_T_node(id)));
  } else {
    group->insert(voxelsOf(node));
  }
  const Eigen::AlignedBox3d box = paddedBox(node.map());
  if (box.isEmpty() || id == kRootId) return group;
  if (parts.boxes) group->insert(boxOf(node, box));
  if (parts.texts) group->insert(textOf(node, box, hierarchy.world_T_node(id)));
  return group;
}

}  // namespace

mrpt::opengl::CSetOfObjects::Ptr sceneOf(const MapHierarchy& hierarchy, const SceneParts& parts) {
  std::map<NodeId, mrpt::opengl::CSetOfObjects::Ptr> groups;
  for (const NodeId id : hierarchy.preorder()) {
    groups[id] = groupOf(hierarchy, id, parts);
    if (const auto& parent = hierarchy.node(id).parent()) groups[*parent]->insert(groups[id]);
  }
  return groups[kRootId];
}

}  // namespace hoctomap
