// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapExport.h"

#include <cmath>
#include <numbers>
#include <system_error>

#include "MapFiles.h"
#include "MapNames.h"
#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/OctreeFile.h"

namespace hoctomap {
namespace {

constexpr std::size_t kDigits = 6;

std::string row(const NodeRecord& node, const std::string& file) {
  const double degrees = 180.0 / std::numbers::pi;
  const Pose& pose = node.world_T_node;
  std::string text = std::to_string(node.id.value) + "," + csvField(node.label.name) + "," +
                     (node.parent ? std::to_string(node.parent->value) : "") + "," + file;
  for (const double number : {node.resolution, node.existence, pose.x(), pose.y(), pose.z(),
                              degrees * pose.yaw(), degrees * pose.pitch(), degrees * pose.roll()}) {
    text += "," + shortestText(number);
  }
  return text + "\n";
}

std::string indexEntry(const NodeRecord& node, const std::string& file) {
  const Pose& pose = node.world_T_node;
  std::string text =
      "MAPNODEID " + std::to_string(node.id.value) + "\nMAPNODEFILENAME " + file + "\nMAPNODEPOSE";
  for (const double number : {pose.x(), pose.y(), pose.z(), pose.roll(), pose.pitch(), pose.yaw()})
    text += " " + shortestText(number + 0.0);  // -0 becomes 0
  return text + "\n";
}

}  // namespace

std::string octreeBytes(const std::filesystem::path& map, const NodeRecord& node, OctreeFormat format) {
  std::string bytes = readChecked(map, node.ot, false);
  const auto tree = parseOt(bytes, node.resolution, (map / node.ot.path).string());
  if (format == OctreeFormat::ot) return bytes;
  node.occupancy.applyTo(*tree);  // which voxels are occupied goes by the node's threshold
  return btBytes(*tree);
}

std::vector<Damage> exportOctrees(const std::filesystem::path& map, const Manifest& manifest,
                                  const std::filesystem::path& folder, OctreeFormat format) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot make the directory: " + error.message());
  for (const std::string& name : listDirectory(folder))
    throw ConfigError(folder.string() + ": is not empty (" + escapedText(name, 100) +
                      "); choose another directory");

  const std::string extension = format == OctreeFormat::ot ? ".ot" : ".bt";
  std::string table = "node,label,parent,file,resolution,existence,x,y,z,yaw,pitch,roll\n";
  std::vector<Damage> damage;
  for (const NodeRecord& node : manifest.nodes) {
    std::string bytes;
    try {
      bytes = octreeBytes(map, node, format);
    } catch (const MapError& problem) {
      damage.push_back({node.ot.path, problem.what()});
      continue;
    }
    const std::string file = padded(node.id.value, kDigits) + extension;
    replaceFile(folder / file, bytes);
    table += row(node, file);
  }
  replaceFile(folder / "nodes.csv", table);
  return damage;
}

std::vector<Damage> exportMapCollection(const std::filesystem::path& map, const Manifest& manifest,
                                        const std::filesystem::path& folder) {
  std::vector<Damage> damage = exportOctrees(map, manifest, folder, OctreeFormat::bt);
  std::string index = "# hoctomap: nodes of a hierarchy, for OctoMap's MapCollection\n";
  for (const NodeRecord& node : manifest.nodes) {
    const std::string file = padded(node.id.value, kDigits) + ".bt";
    if (std::filesystem::exists(folder / file)) index += indexEntry(node, file);
  }
  replaceFile(folder / "mapcollection.txt", index);
  return damage;
}

std::string objectTable(const Manifest& manifest) {
  const double degrees = 180.0 / std::numbers::pi;
  std::string table =
      "node,label,parent,existence,x,y,z,yaw,pitch,roll,box_x,box_y,box_z,size_x,size_y,size_z,volume,"
      "occupied_voxels,resolution,first_scan,last_scan\n";
  for (const NodeRecord& node : manifest.nodes) {
    if (!node.parent) continue;
    const Pose& pose = node.world_T_node;
    const Eigen::Vector3d center = toIsometry(pose) * node.box_center;
    const Eigen::Vector3d size = 2.0 * node.box_half_extents;
    const double volume = static_cast<double>(node.voxels.occupied) * std::pow(node.resolution, 3);
    table += std::to_string(node.id.value) + "," + csvField(node.label.name) + "," +
             std::to_string(node.parent->value);
    for (const double number :
         {node.existence, pose.x(), pose.y(), pose.z(), degrees * pose.yaw(), degrees * pose.pitch(),
          degrees * pose.roll(), center.x(), center.y(), center.z(), size.x(), size.y(), size.z(), volume})
      table += "," + shortestText(number);
    table += "," + std::to_string(node.voxels.occupied) + "," + shortestText(node.resolution) + "," +
             std::to_string(node.first_scan) + "," + std::to_string(node.last_scan) + "\n";
  }
  return table;
}

}  // namespace hoctomap
