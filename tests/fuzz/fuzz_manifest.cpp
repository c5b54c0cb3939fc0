// SPDX-License-Identifier: BSD-3-Clause
// The manifest: what is accepted is one tree, and says the same when it is written and read again.
#include <cmath>

#include "FuzzTarget.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap::fuzz {

namespace {

FileRecord file(const std::string& path) {
  return {path, 100, std::string(64, 'a')};
}

NodeRecord node(std::uint32_t id, const Label& label) {
  NodeRecord record;
  record.id = NodeId{id};
  record.label = label;
  record.resolution = 0.01;
  record.existence_log_odds = 2.0;
  record.existence = 1.0 / (1.0 + std::exp(-2.0));
  record.ot = file("nodes/00000" + std::to_string(id) + "-000003.ot");
  record.bt = file("nodes/00000" + std::to_string(id) + "-000003.bt");
  return record;
}

/// Without its own hash, at which every mutation would end.
std::string withoutHash(const std::string& yaml) {
  return yaml.substr(yaml.find('\n') + 1);
}

}  // namespace

std::vector<std::string> seeds() {
  Manifest manifest;
  manifest.generator = "hoctomap";
  manifest.scans = 4;
  manifest.config_sha256 = std::string(64, 'b');
  manifest.next_id = NodeId{5};
  manifest.config = file("config.ini");
  manifest.events = file("events.csv");
  manifest.existence = file("existence.csv");
  manifest.nodes = {node(0, labels::background), node(1, labels::table)};
  manifest.nodes[0].children = {NodeId{1}};
  manifest.nodes[1].parent = kRootId;
  const std::string small = toYaml(manifest);
  manifest.seams = file("nodes/seams-000004.csv");
  manifest.sensor = StillSensor{Pose(1, 2, 3, 0.1, 0.2, 0.3), 2};
  manifest.motions = MotionsTaken{3, 1.5, 1, std::string(64, 'c')};
  manifest.removed = {node(3, labels::object)};
  manifest.removed[0].parent = NodeId{1};
  manifest.removed[0].removed_scan = 2;
  manifest.waiting = {node(4, labels::object)};
  manifest.waiting[0].parent = NodeId{1};
  manifest.waiting[0].confirmation.waits = true;
  return {withoutHash(small), withoutHash(toYaml(manifest)), small};
}

void read(std::string_view bytes) {
  const Manifest manifest = parseManifest(std::string(bytes), "hierarchy.yaml");
  require(!manifest.nodes.empty() && manifest.nodes.front().id == kRootId, "the root comes first");
  const std::string written = toYaml(manifest);
  require(toYaml(parseManifest(written, "hierarchy.yaml")) == written, "a manifest survives the round trip");
}

}  // namespace hoctomap::fuzz
