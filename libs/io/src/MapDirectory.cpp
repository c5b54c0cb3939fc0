// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapDirectory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "ManifestHead.h"
#include "MapNames.h"
#include "MapSession.h"
#include "NodeIndex.h"
#include "NumberText.h"
#include "PreviousMap.h"
#include "SeamsFile.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

}  // namespace

ScanRow scanRow(const Measurement& z) {
  ScanRow row{z.scan, z.stamp, z.sensor, z.world_points.size(), z.world_T_sensor};
  if (z.image) {
    const PinholeCamera& camera = z.image->camera;
    row.fov_x = 2.0 * std::atan2(0.5 * camera.width, camera.fx);
    row.fov_y = 2.0 * std::atan2(0.5 * camera.height, camera.fy);
  }
  return row;
}

MapDirectory::MapDirectory(std::filesystem::path directory, MapDirectoryOptions options)
    : directory_(std::move(directory)), session_(std::make_unique<Session>(directory_, std::move(options))) {}
MapDirectory::~MapDirectory() = default;

const std::optional<Manifest>& MapDirectory::committed() const {
  return session_->committed();
}
void MapDirectory::append(const UpdateReport& report) {
  session_->addRows(report);
}
void MapDirectory::appendEnd(const UpdateReport& report) {
  session_->addEnd(report);
}
void MapDirectory::append(const ScanRow& row) {
  session_->addRow(row);
}
void MapDirectory::append(const TimingRow& row) {
  session_->addRow(row);
}
void MapDirectory::commit(const MapState& state) {
  session_->commit(state);
}
void MapDirectory::writeScene(const SceneMaker& maker) {
  session_->writeScene(maker);
}

void MapDirectory::Session::addRows(const UpdateReport& report) {
  const std::string scan = std::to_string(report.scan) + ",";
  for (const NodeEvent& event : report.events) {
    events_.add(scan + shortestText(report.stamp) + "," + toString(event.kind) + "," +
                std::to_string(event.node.value) + "," + csvField(event.label.name) + "," +
                shortestText(event.existence) + "," + csvField(event.detail));
  }
  for (const ExistenceEntry& entry : report.existence) {
    const Evidence& evidence = entry.evidence;
    existence_.add(scan + std::to_string(entry.node.value) + "," + std::to_string(evidence.present) + "," +
                   std::to_string(evidence.absent) + "," + std::to_string(evidence.occluded) + "," +
                   shortestText(evidence.p_measurement) + "," + shortestText(entry.p_posterior));
  }
}

void MapDirectory::Session::addEnd(const UpdateReport& report) {
  if (report.events.empty()) return;
  events_before_end_ = events_.record();
  addRows(report);
}

void MapDirectory::Session::addRow(const ScanRow& row) {
  std::string text = std::to_string(row.scan) + "," + shortestText(row.stamp) + "," + csvField(row.sensor) +
                     "," + std::to_string(row.points);
  if (row.world_T_sensor) {
    const Pose& pose = *row.world_T_sensor;
    for (const double number :
         {pose.x(), pose.y(), pose.z(), degrees(pose.yaw()), degrees(pose.pitch()), degrees(pose.roll())}) {
      text += "," + shortestText(number);
    }
  } else {
    text += ",,,,,,";
  }
  for (const std::optional<double>& angle : {row.fov_x, row.fov_y}) {
    text += "," + (angle ? shortestText(degrees(*angle)) : std::string());
  }
  scans_.add(text + "," + csvField(row.skipped));
}

void MapDirectory::Session::addRow(const TimingRow& row) {
  std::string text = std::to_string(row.scan) + "," + std::to_string(row.points);
  for (const double seconds : {row.read_s, row.stages.segment, row.stages.associate, row.stages.update,
                               row.stages.existence, row.write_s}) {
    text += "," + shortestText(seconds);
  }
  timing_.add(text);
}

void MapDirectory::Session::commit(const MapState& state) {
  if (overwriting_) makeWay();
  if (committed_ && events_.replaces()) committed_ = setEventsAside(disk_, directory_, *committed_);
  disk_.makeDirectory(directory_ / kNodesFolder);
  Manifest manifest = describe(state);
  if (!config_written_) disk_.replace(directory_ / kConfigName, options_.config);
  config_written_ = true;
  manifest.events = events_.write(disk_, directory_);
  manifest.events_before_end = events_before_end_;
  manifest.seams = writeSeams(state, manifest.edits);
  const std::string nodes_text = manifestNodesText(manifest);
  manifest.index = writeIndex(state, manifest, nodes_text);
  manifest.existence = existence_.write(disk_, directory_);
  manifest.scan_table = scans_.write(disk_, directory_);
  static_cast<void>(timing_.write(disk_, directory_));
  disk_.syncDirectory(directory_ / kNodesFolder);
  disk_.syncDirectory(directory_);

  commitManifest(manifest, nodes_text, state.keep && state.scans > 0);

  removeUnnamedFiles();
}

/// Named by the scan, as a node's file is: never changed once it is written.
std::optional<FileRecord> MapDirectory::Session::writeSeams(const MapState& state, std::uint64_t edits) {
  if (state.seams == nullptr || state.seams->all().empty()) return std::nullopt;
  const std::string bytes = seamsText(*state.seams);
  const FileRecord record{std::string(kNodesFolder) + "/" + seamsFileName(state.scans, edits), bytes.size(),
                          sha256Hex(bytes)};
  const bool is_there = committed_ && committed_->seams == record;
  if (!is_there) disk_.replace(directory_ / record.path, bytes);
  return record;
}

FileRecord MapDirectory::Session::writeIndex(const MapState& state, const Manifest& manifest,
                                             const std::string& nodes_text) {
  std::map<NodeId, VoxelExtent> extents;
  for (const NodeRecord& node : manifest.nodes)
    extents[node.id] = node_files_.extent(state.hierarchy.node(node.id));
  const std::string bytes = nodeIndexBytes(manifest, nodes_text, extents);
  const std::string hash = sha256Hex(bytes);
  const FileRecord record{std::string(kNodesFolder) + "/" + indexFileName(hash), bytes.size(), hash};
  const bool is_there = committed_ && committed_->index == record;
  if (!is_there) disk_.replace(directory_ / record.path, bytes);
  return record;
}

/// A new map takes the place of an old one: see PreviousMap.h.
void MapDirectory::Session::makeWay() {
  if (old_) setAside(disk_, directory_, *old_);
  // Kept states of the old map name files that are about to be replaced.
  for (const std::uint64_t scan : snapshotScans(directory_)) disk_.remove(directory_ / snapshotName(scan));
  disk_.syncDirectory(directory_);
  overwriting_ = false;
}

void MapDirectory::Session::writeNodes(const MapState& state) {
  std::vector<const MapNode*> nodes;
  for (const NodeId id : state.hierarchy.preorder()) nodes.push_back(&state.hierarchy.node(id));
  for (const RemovedNode& removed : state.removed) nodes.push_back(&removed.node);
  node_files_.write(nodes);
}

Manifest MapDirectory::Session::describe(const MapState& state) {
  writeNodes(state);
  const auto waits = [&](NodeId id) { return state.hierarchy.node(id).confirmation.waits; };
  const auto byId = [](const NodeRecord& a, const NodeRecord& b) { return a.id < b.id; };
  Manifest manifest;
  manifest.generator = options_.generator;
  manifest.scans = state.scans;
  manifest.edits = editsBefore() + (options_.mode == MapOpenMode::edit ? 1 : 0);
  manifest.last_stamp = state.last_stamp;
  manifest.mapped_scans = state.mapped_scans;
  manifest.skipped_scans = state.skipped_scans;
  manifest.config_sha256 = sha256Hex(options_.config);
  manifest.config = {kConfigName, options_.config.size(), manifest.config_sha256};
  manifest.input = state.input;
  manifest.next_id = state.hierarchy.nextId();
  manifest.sensor = state.sensor;
  manifest.motions = state.motions;
  for (const NodeId id : state.hierarchy.preorder()) {
    NodeRecord record = node_files_.record(state.hierarchy.node(id), state.hierarchy.world_T_node(id));
    std::erase_if(record.children, [&](NodeId child) { return waits(child); });
    (waits(id) ? manifest.waiting : manifest.nodes).push_back(std::move(record));
  }
  std::sort(manifest.waiting.begin(), manifest.waiting.end(), byId);
  manifest.removed = removed_before_;
  for (const RemovedNode& removed : state.removed) {
    NodeRecord record = node_files_.record(removed.node, removed.world_T_node);
    record.children.clear();  // they have gone to another parent
    record.removed_scan = removed.removed_scan;
    manifest.removed.push_back(std::move(record));
  }
  std::sort(manifest.removed.begin(), manifest.removed.end(), byId);
  return manifest;
}

void MapDirectory::Session::commitManifest(const Manifest& manifest, const std::string& nodes_text,
                                           bool keep) {
  const std::string text = manifestText(manifest, nodes_text);
  if (keep) {
    disk_.replace(directory_ / snapshotName(manifest.scans - 1), text);
    for (const FileRecord& file : manifest.files()) kept_files_.insert(file.path);
  }
  disk_.replace(directory_ / kManifestName, text);
  // From here on it is the map of the directory, whether or not the last sync succeeds.
  events_.accept();
  existence_.accept();
  scans_.accept();
  timing_.accept();
  committed_ = manifest;
  disk_.syncDirectory(directory_);
}

void MapDirectory::Session::removeUnnamedFiles() {
  try {
    std::set<std::string> named = kept_files_;
    for (const FileRecord& file : committed_->files()) named.insert(file.path);
    for (const std::string& name : listDirectory(directory_ / kNodesFolder)) {
      const bool ours =
          isNodeFileName(name) || isSeamsFileName(name) || isIndexFileName(name) || isOurTemporary(name);
      const std::string path = std::string(kNodesFolder) + "/" + name;
      if (ours && !named.contains(path)) disk_.remove(directory_ / path);
    }
    for (const std::string& name : listDirectory(directory_)) {
      if (isOurTemporary(name)) disk_.remove(directory_ / name);
    }
    if (!committed_->scene) disk_.remove(directory_ / kSceneName);
    removePrevious(disk_, directory_, *committed_);
  } catch (const FileError&) {
    // The map is committed and whole; what could not be removed is so on the next occasion.
  }
}

void MapDirectory::Session::writeScene(const SceneMaker& maker) {
  if (!committed_) throw std::logic_error("writeScene needs a committed map");
  if (committed_->scene) return;  // it shows this very state
  const auto file = directory_ / kSceneName;
  const auto temporary = Disk::temporaryOf(file);
  disk_.remove(temporary);
  maker(directory_, temporary);
  const std::string bytes = readWholeFile(temporary);
  disk_.adopt(temporary, file);
  disk_.syncDirectory(directory_);
  Manifest manifest = *committed_;
  manifest.scene = FileRecord{kSceneName, bytes.size(), sha256Hex(bytes)};
  disk_.replace(directory_ / kManifestName, toYaml(manifest));
  committed_ = std::move(manifest);
  disk_.syncDirectory(directory_);
}

}  // namespace hoctomap
