// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MotionFile.h"

#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {
namespace {

/// One row, by the names of the header.
class Row {
 public:
  Row(std::string place, const std::vector<std::string>& names, const std::vector<std::string>& values)
      : place_(std::move(place)) {
    if (names.size() != values.size()) {
      refuse("has " + std::to_string(values.size()) + " values, the header " + std::to_string(names.size()));
    }
    for (std::size_t i = 0; i < names.size(); ++i) values_[names[i]] = values[i];
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(place_ + ": " + what); }
  [[nodiscard]] bool has(const std::string& name) const {
    const auto found = values_.find(name);
    return found != values_.end() && !found->second.empty();
  }
  [[nodiscard]] const std::string& text(const std::string& name) const {
    if (!has(name)) refuse("has no `" + name + "`");
    return values_.at(name);
  }
  [[nodiscard]] double number(const std::string& name) const {
    const auto value = parseNumber(text(name));
    if (!value) refuse("`" + name + "` is no number: " + escapedText(text(name), 60));
    return *value;
  }
  [[nodiscard]] std::uint64_t count(const std::string& name) const {
    const auto value = parseCount(text(name));
    if (!value) refuse("`" + name + "` is no whole number: " + escapedText(text(name), 60));
    return *value;
  }

 private:
  std::string place_;
  std::map<std::string, std::string> values_;
};

std::vector<std::string> fieldsOf(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else if (c != ' ') {
      fields.back() += c;
    }
  }
  return fields;
}

ToldMotion motionOf(const Row& row, std::size_t line) {
  ToldMotion motion;
  motion.line = line;
  if (row.has("scan") == row.has("time")) row.refuse("needs either `scan` or `time`");
  if (row.has("scan")) {
    motion.when = row.count("scan");
  } else {
    motion.when = row.number("time");
  }
  if (row.has("node") == row.has("px")) row.refuse("needs either `node` or `px,py,pz`");
  if (row.has("node")) {
    motion.what = NodeId{static_cast<std::uint32_t>(row.count("node"))};
  } else {
    motion.what = Eigen::Vector3d(row.number("px"), row.number("py"), row.number("pz"));
  }
  const double degree = std::numbers::pi / 180.0;
  motion.motion = Pose(row.number("x"), row.number("y"), row.number("z"), degree * row.number("yaw"),
                       degree * row.number("pitch"), degree * row.number("roll"));
  if (row.has("frame")) {
    motion.in_world = row.text("frame") == "world";
    if (!motion.in_world && row.text("frame") != "node") row.refuse("`frame` is neither `node` nor `world`");
  }
  return motion;
}

}  // namespace

bool ToldMotion::isDue(std::uint64_t scan, double stamp) const {
  if (const auto* number = std::get_if<std::uint64_t>(&when)) return scan >= *number;
  return stamp >= std::get<double>(when);
}

std::vector<ToldMotion> readMotionFile(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (std::filesystem::is_directory(file) || !std::getline(in, line)) {
    throw InputError(file.string() + ": cannot be read, or is empty");
  }
  const auto names = fieldsOf(line);
  std::vector<ToldMotion> motions;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const Row row(file.string() + " line " + std::to_string(number), names, fieldsOf(line));
    motions.push_back(motionOf(row, number));
    motions.back().text = line;
  }
  return motions;
}

std::optional<NodeId> findNode(const MapHierarchy& hierarchy, const ToldMotion& motion) {
  if (const auto* id = std::get_if<NodeId>(&motion.what)) {
    if (*id == kRootId || !hierarchy.contains(*id)) return std::nullopt;
    return *id;
  }
  const auto& point = std::get<Eigen::Vector3d>(motion.what);
  std::optional<NodeId> best;
  for (const NodeId id : hierarchy.ids()) {
    const Obb box = hierarchy.box(id);
    if (id == kRootId || !box.contains(point)) continue;
    const bool deeper = best && hierarchy.depth(id) > hierarchy.depth(*best);
    const bool smaller = best && hierarchy.depth(id) == hierarchy.depth(*best) &&
                         box.box.volume() < hierarchy.box(*best).box.volume();
    if (!best || deeper || smaller) best = id;
  }
  return best;
}

Pose motionInNodeFrame(const MapHierarchy& hierarchy, NodeId node, const ToldMotion& motion) {
  if (!motion.in_world) return motion.motion;
  const Pose world_T_node = hierarchy.world_T_node(node);
  return -world_T_node + motion.motion + world_T_node;
}

}  // namespace hoctomap
