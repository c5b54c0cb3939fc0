// SPDX-License-Identifier: BSD-3-Clause
#include "MapPart.h"

#include <fstream>

#include "FileText.h"
#include "VoxelBytes.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapDescription.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxVoxels = 50'000'000;  ///< what a browser can take

/// The lines of the run's log that begin with `warning: `.
Json warnings(const std::filesystem::path& directory) {
  Json list = Json::array();
  std::ifstream in(directory / "log.txt");
  const std::string mark = "warning: ";
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(mark)) list.push_back(line.substr(mark.size()));
  }
  return list;
}

Json matrixJson(const Pose& pose) {
  const Eigen::Matrix4d matrix = toIsometry(pose).matrix();
  Json numbers = Json::array();
  for (Eigen::Index i = 0; i < 16; ++i) numbers.push_back(matrix(i / 4, i % 4));
  return numbers;
}

/// How often nodes were `updated` says nothing that first and last scan do not.
Json eventsJson(const std::filesystem::path& directory, const Manifest& manifest) {
  Json rows = Json::array();
  for (const EventRow& row : readEvents(directory, manifest)) {
    if (row.event == "updated" && row.detail.find("by hand") == std::string::npos) continue;
    rows.push_back({{"scan", row.scan},
                    {"event", row.event},
                    {"node", row.node.value},
                    {"label", row.label.name},
                    {"existence", row.existence},
                    {"detail", row.detail}});
  }
  return rows;
}

/// Rows `[scan, node, present, absent, occluded, posterior]`.
Json existenceJson(const std::filesystem::path& directory, const Manifest& manifest) {
  Json rows = Json::array();
  for (const ExistenceRow& row : readExistence(directory, manifest)) {
    rows.push_back({row.scan, row.node.value, row.present, row.absent, row.occluded, row.p_posterior});
  }
  return rows;
}

Json scansJson(const std::filesystem::path& directory, const Manifest& manifest) {
  Json rows = Json::array();
  for (const ScanTableRow& row : readScans(directory, manifest)) {
    Json json{{"scan", row.scan}, {"time", row.time}, {"sensor", row.sensor}, {"points", row.points}};
    if (row.world_T_sensor) json["pose"] = matrixJson(*row.world_T_sensor);
    if (row.fov_x && row.fov_y) json["fov"] = {*row.fov_x, *row.fov_y};
    if (!row.skipped.empty()) json["skipped"] = row.skipped;
    rows.push_back(std::move(json));
  }
  return rows;
}

/// Rows `[scan, points, read, segment, associate, update, existence, write]`, seconds.
Json timingJson(const std::filesystem::path& directory, const Manifest& manifest) {
  Json rows = Json::array();
  for (const TimingTableRow& t : readTiming(directory, manifest)) {
    rows.push_back({t.scan, t.points, t.read, t.segment, t.associate, t.update, t.existence, t.write});
  }
  return rows;
}

void addVoxels(Page& page, const StoredMap& map, const std::string& prefix) {
  std::uint64_t voxels = 0;
  for (const auto* list : {&map.manifest.nodes, &map.manifest.removed}) {
    for (const NodeRecord& node : *list) voxels += node.voxels.occupied;
  }
  if (voxels > kMaxVoxels) {
    throw LimitError("the map has " + std::to_string(voxels) + " occupied voxels; a report shows at most " +
                     std::to_string(kMaxVoxels));
  }
  const auto add = [&](const MapNode& node) {
    page.add(prefix + std::to_string(node.id().value), voxelBytes(node.map()));
  };
  for (const NodeId id : map.hierarchy.preorder()) add(map.hierarchy.node(id));
  for (const RemovedNode& removed : map.removed) add(removed.node);
}

}  // namespace

Json addMap(Page& page, const std::filesystem::path& directory, std::optional<std::uint64_t> at_scan,
            const std::string& prefix) {
  MapReadOptions options;
  options.at_scan = at_scan;
  options.removed = true;
  const StoredMap map = readMap(directory, options);
  addVoxels(page, map, prefix);
  const Manifest& manifest = map.manifest;
  Json json = Json::parse(mapJson(manifest));
  json["path"] = directory.string();
  json["prefix"] = prefix;
  json["mapped_scans"] = manifest.mapped_scans;
  json["skipped_scans"] = manifest.skipped_scans;
  json["events"] = eventsJson(directory, manifest);
  json["existence"] = existenceJson(directory, manifest);
  json["scan_table"] = scansJson(directory, manifest);
  json["timing"] = timingJson(directory, manifest);
  json["config"] = fileText(directory / manifest.config.path);
  json["warnings"] = warnings(directory);
  return json;
}

}  // namespace hoctomap
