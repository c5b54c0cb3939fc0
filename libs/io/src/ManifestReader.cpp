// SPDX-License-Identifier: BSD-3-Clause
// Reading `hierarchy.yaml`. With yaml-cpp: `mrpt::containers::yaml` reads what we write, but of a damaged
// text it returns a part, prints to stderr, or crashes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "ManifestHash.h"
#include "ManifestHead.h"
#include "ManifestTree.h"
#include "PoseText.h"
#include "RecordChecks.h"
#include "YamlLimits.h"
#include "YamlSection.h"
#include "hoctomap/existence/ExistenceFilter.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {
namespace {

constexpr double kPoseTextTolerance = 1e-6;

NodeId readId(const YamlSection& section) {
  const std::uint64_t value = section.count();
  if (value >= std::numeric_limits<std::uint32_t>::max()) section.refuse("is too large for a node id");
  return NodeId{static_cast<std::uint32_t>(value)};
}

std::string readPath(const YamlSection& section) {
  std::string path = section.text();
  if (!staysInside(path)) {
    section.refuse("\"" + escapedText(path, 200) + "\" leads out of the map directory");
  }
  return path;
}

FileRecord readFile(const YamlSection& section) {
  FileRecord file{readPath(section["path"]), section["bytes"].count(), section["sha256"].text()};
  if (!isSha256(file.sha256)) section["sha256"].refuse("is no SHA-256");
  return file;
}

/// The exact matrix is the pose; the text beside it must say the same, or somebody has edited one of them.
Pose readMatrix(const YamlSection& matrix) {
  Pose pose;
  try {
    pose = poseFromNumbers(matrix.numbers<16>());
  } catch (const std::invalid_argument& error) {
    matrix.refuse(error.what());
  }
  return pose;
}

Pose readPose(const YamlSection& node, const std::string& text_key, const std::string& matrix_key) {
  const Pose pose = readMatrix(node[matrix_key]);
  const auto text = parsePoseText(node[text_key].text());
  if (!text) node[text_key].refuse("is no pose \"[x y z yaw pitch roll]\"");
  double scale = 1.0;
  for (const double number : matrixNumbers(pose)) scale = std::max(scale, std::abs(number));
  if (!nearlyEqual(pose, *text, kPoseTextTolerance * scale)) {
    node[text_key].refuse("is another pose than `" + matrix_key + "`");
  }
  return pose;
}

double readProbability(const YamlSection& section) {
  const double value = section.number();
  if (!(value > 0.0 && value < 1.0)) section.refuse(shortestText(value) + " is not between 0 and 1");
  return value;
}

OccupancyModel readOccupancy(const YamlSection& section) {
  OccupancyModel model{readProbability(section["prob_hit"]), readProbability(section["prob_miss"]),
                       readProbability(section["clamping_min"]), readProbability(section["clamping_max"]),
                       readProbability(section["occupancy_threshold"])};
  if (!(model.clamping_min < model.clamping_max)) section.refuse("clamping_min is not below clamping_max");
  return model;
}

void readExistence(const YamlSection& section, NodeRecord& node) {
  node.existence = readProbability(section["existence"]);
  node.existence_log_odds = section["existence_log_odds"].number();
  if (std::abs(probability(node.existence_log_odds) - node.existence) > 1e-9) {
    section["existence_log_odds"].refuse("is another value than `existence`");
  }
}

void readBox(const YamlSection& section, NodeRecord& node) {
  const auto center = section["center"].numbers<3>();
  const auto half = section["half_extents"].numbers<3>();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (half.at(i) < 0.0) section["half_extents"].refuse("has a negative extent");
    node.box_center[axis] = center.at(i);
    node.box_half_extents[axis] = half.at(i);
  }
}

/// Which list of the manifest a node is in.
enum class NodeList { tree, removed, waiting };

Confirmation readConfirmation(const YamlSection& section, NodeList list) {
  Confirmation confirmation;
  if (list != NodeList::waiting && !section.has("held_back")) return confirmation;
  confirmation.waits = list == NodeList::waiting;
  confirmation.entered_at_end = list == NodeList::tree;
  confirmation.shown = section["held_back"]["shown"].count();
  confirmation.missed = section["held_back"]["missed"].count();
  confirmation.points = section["held_back"]["points"].count();
  confirmation.enough = section["held_back"]["enough"].flag();
  return confirmation;
}

NodeRecord readNode(const YamlSection& section, NodeList list) {
  NodeRecord node;
  node.id = readId(section["id"]);
  node.label.name = section["label"].text();
  if (!section["parent"].isNull()) node.parent = readId(section["parent"]);
  for (const YamlSection& child : section["children"].items()) node.children.push_back(readId(child));
  std::sort(node.children.begin(), node.children.end());
  node.parent_T_node = readPose(section, "pose", "pose_matrix");
  node.world_T_node = readPose(section, "world_pose", "world_pose_matrix");
  node.resolution = section["resolution"].number();
  if (!(node.resolution > 0.0)) section["resolution"].refuse("is not above 0");
  readExistence(section, node);
  readBox(section["obb"], node);
  node.voxels = {section["occupied_voxels"].count(), section["free_voxels"].count()};
  node.memory_bytes = section["memory_bytes"].count();
  node.first_scan = section["first_scan"].count();
  node.last_scan = section["last_scan"].count();
  node.version = section["version"].count();
  if (section.has("edition")) node.edition = section["edition"].count();
  const YamlSection votes = section["votes"];
  node.votes.apart = votes["apart"].count();
  node.votes.joined = votes["joined"].count();
  node.votes.with = NodeId{static_cast<std::uint32_t>(votes["with"].count())};
  node.confirmation = readConfirmation(section, list);
  if (list == NodeList::removed) node.removed_scan = section["removed_scan"].count();
  node.occupancy = readOccupancy(section["occupancy"]);
  node.ot = readFile(section["files"]["ot"]);
  node.bt = readFile(section["files"]["bt"]);
  return node;
}

std::vector<NodeRecord> readNodes(const YamlSection& section, NodeList list, const std::string& name) {
  std::vector<NodeRecord> nodes;
  for (const YamlSection& item : section.items()) {
    if (nodes.size() >= kMaxMapNodes) {
      throw LimitError(name + ": a map may have " + std::to_string(kMaxMapNodes) + " nodes at most");
    }
    nodes.push_back(readNode(item, list));
  }
  return nodes;
}

void readVersion(const YamlSection& document) {
  const std::uint64_t version = document["format_version"].count();
  if (version == kMapFormatVersion) return;
  document["format_version"].refuse("the map has format version " + std::to_string(version) +
                                    ", this program reads version " + std::to_string(kMapFormatVersion) +
                                    (version > kMapFormatVersion ? "; use a newer program" : ""));
}

void checkOwnHash(std::string_view text, const std::string& name) {
  if (hasWrongOwnHash(text))
    throw MapError(name +
                   ": the hash in its first line is not that of what follows: the file is damaged (who "
                   "edits it by hand takes that line out)");
}

/// All but the nodes.
Manifest readHead(const YamlSection& document) {
  readVersion(document);
  Manifest manifest;
  manifest.generator = document["generator"].text();
  manifest.scans = document["scans"].count();
  if (document.has("mapped_scans")) manifest.mapped_scans = document["mapped_scans"].count();
  if (document.has("skipped_scans")) manifest.skipped_scans = document["skipped_scans"].count();
  if (document.has("edits")) manifest.edits = document["edits"].count();
  if (document.has("last_stamp")) manifest.last_stamp = document["last_stamp"].number();
  manifest.config_sha256 = document["config_sha256"].text();
  manifest.input = document["input"].text();
  manifest.next_id = readId(document["next_id"]);
  const YamlSection files = document["files"];
  manifest.config = readFile(files["config"]);
  manifest.events = readFile(files["events"]);
  manifest.existence = readFile(files["existence"]);
  if (files.has("scans")) manifest.scan_table = readFile(files["scans"]);
  if (files.has("events_before_end")) manifest.events_before_end = readFile(files["events_before_end"]);
  if (files.has("seams")) manifest.seams = readFile(files["seams"]);
  if (files.has("index")) manifest.index = readFile(files["index"]);
  if (files.has("scene")) manifest.scene = readFile(files["scene"]);
  if (document.has("sensor")) {
    const YamlSection sensor = document["sensor"];
    manifest.sensor = StillSensor{readMatrix(sensor["pose_matrix"]), sensor["still_since"].count()};
  }
  if (document.has("motions")) {
    const YamlSection motions = document["motions"];
    manifest.motions = MotionsTaken{motions["scan"].count(), motions["time"].number(),
                                    motions["after_scan"].count(), motions["told_sha256"].text()};
  }
  return manifest;
}

Manifest readDocument(const YamlSection& document, const std::string& name) {
  Manifest manifest = readHead(document);
  manifest.nodes = orderedTree(readNodes(document["nodes"], NodeList::tree, name), name);
  manifest.removed = readNodes(document["removed"], NodeList::removed, name);
  if (document.has("waiting")) manifest.waiting = readNodes(document["waiting"], NodeList::waiting, name);
  checkIds(manifest, name);
  return manifest;
}

template <class Read>
Manifest parse(const std::string& text, const std::string& name, const Read& read) {
  try {
    requireSimpleYaml(text, name);
    return read(YamlSection(YAML::Load(text), name));
  } catch (const YAML::Exception& error) {
    throw MapError(name + ": line " + std::to_string(error.mark.line + 1) + ": " + escapedText(error.msg));
  }
}

}  // namespace

bool hasWrongOwnHash(std::string_view text) {
  if (!text.starts_with(kOwnHashMark)) return false;
  const std::size_t rest = std::min(text.find('\n'), text.size() - 1) + 1;
  return text.substr(0, rest) != ownHashLine(text.substr(rest));
}

Manifest parseManifest(const std::string& text, const std::string& name) {
  return parse(text, name, [&](const YamlSection& document) {
    Manifest manifest = readDocument(document, name);
    checkOwnHash(text, name);
    return manifest;
  });
}

Manifest parseManifestHead(const std::string& text, const std::string& name) {
  return parse(text, name, readHead);
}

}  // namespace hoctomap
