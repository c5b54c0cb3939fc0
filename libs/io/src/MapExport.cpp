// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapExport.h"

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

std::string octreeBytes(const std::filesystem::path& map, const NodeRecord& node, OctreeFormat format) {
  std::string bytes = readChecked(map, node.ot, false);
  const auto tree = parseOt(bytes, node.resolution, (map / node.ot.path).string());
  if (format == OctreeFormat::ot) return bytes;
  node.occupancy.applyTo(*tree);  // which voxels are occupied goes by the node's threshold
  return btBytes(*tree);
}

}  // namespace

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

}  // namespace hoctomap
