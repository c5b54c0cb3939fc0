// SPDX-License-Identifier: BSD-3-Clause
#include "DiffOutput.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "TextTable.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kKinds{ChangeKind::added, ChangeKind::removed, ChangeKind::moved, ChangeKind::changed,
                            ChangeKind::unobservable};
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// x, y, z in metres; yaw, pitch, roll in degrees.
std::array<double, 6> sixNumbers(const Eigen::Isometry3d& motion) {
  const Pose pose = poseFromMatrix(motion.matrix());
  return {
      pose.x(), pose.y(), pose.z(), kDegrees * pose.yaw(), kDegrees * pose.pitch(), kDegrees * pose.roll()};
}

std::string idText(const std::optional<NodeId>& id) {
  return id ? std::to_string(id->value) : "-";
}

std::string pointText(const Eigen::Vector3d& p) {
  return fixedText(p.x(), 3) + " " + fixedText(p.y(), 3) + " " + fixedText(p.z(), 3);
}

std::string whatText(const Change& change) {
  const std::string percent = std::to_string(static_cast<int>(100.0 * change.score + 0.5)) + " %";
  std::string text;
  switch (change.kind) {
    case ChangeKind::moved: {
      // Where it went says more to people than the world's motion, whose shift depends on the origin.
      const auto six = sixNumbers(change.motion);
      text = "by " + pointText(change.motion * change.position - change.position) + " m; yaw " +
             fixedText(six[3], 1) + " pitch " + fixedText(six[4], 1) + " roll " + fixedText(six[5], 1) +
             " deg; fits to " + percent;
      break;
    }
    case ChangeKind::changed:
      text = "shape agrees to " + percent;
      break;
    default:
      text = "place seen to " + percent;
  }
  if (!change.carried.empty()) {
    text += "; with it";
    for (const auto& [a, b] : change.carried) text += " " + idText(a) + ">" + idText(b);
  }
  return change.detail.empty() ? text : text + "; " + change.detail;
}

std::string countsText(std::span<const Change> changes) {
  if (changes.empty()) return "no changes\n";
  std::string text;
  for (const ChangeKind kind : kKinds) {
    const auto count = std::count_if(changes.begin(), changes.end(),
                                     [kind](const Change& change) { return change.kind == kind; });
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + toString(kind);
  }
  return text + "\n";
}

std::string mapLine(const std::string& name, const ComparedMap& map) {
  return name + "  " + escapedText(map.path) + ": after " + std::to_string(map.manifest.scans) + " scans, " +
         std::to_string(map.manifest.nodes.size()) + " nodes\n";
}

Json mapJson(const ComparedMap& map) {
  return {{"path", map.path}, {"scans", map.manifest.scans}, {"nodes", map.manifest.nodes.size()}};
}

Json idJson(const std::optional<NodeId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}

Json matrixJson(const Eigen::Matrix4d& matrix) {
  Json numbers = Json::array();
  for (Eigen::Index i = 0; i < 16; ++i) numbers.push_back(matrix(i / 4, i % 4));
  return numbers;
}

Json changeJson(const Change& change) {
  Json json{{"change", toString(change.kind)},
            {"node_a", idJson(change.node_a)},
            {"node_b", idJson(change.node_b)},
            {"label", change.label.name},
            {"position", {change.position.x(), change.position.y(), change.position.z()}},
            {"score", change.score}};
  if (change.kind == ChangeKind::moved) {
    json["motion"] = sixNumbers(change.motion);
    json["motion_matrix"] = matrixJson(change.motion.matrix());
    json["carried"] = Json::array();
    for (const auto& [a, b] : change.carried) {
      json["carried"].push_back({{"node_a", a.value}, {"node_b", b.value}});
    }
  }
  if (!change.detail.empty()) json["detail"] = change.detail;
  return json;
}

}  // namespace

std::string diffText(const ComparedMap& a, const ComparedMap& b, std::span<const Change> changes) {
  std::string text = mapLine("A", a) + mapLine("B", b) + "\n";
  if (!changes.empty()) {
    TextTable table({"change", "in A", "in B", "label", "at [m]", ""});
    for (const Change& change : changes) {
      table.add({toString(change.kind), idText(change.node_a), idText(change.node_b),
                 escapedText(change.label.name, 60), pointText(change.position), whatText(change)});
    }
    text += table.text() + "\n";
  }
  return text + countsText(changes);
}

std::string diffJson(const ComparedMap& a, const ComparedMap& b, const Pose& a_T_b,
                     std::span<const Change> changes) {
  Json list = Json::array();
  Json counts = Json::object();
  for (const ChangeKind kind : kKinds) counts[toString(kind)] = 0;
  for (const Change& change : changes) {
    list.push_back(changeJson(change));
    counts[toString(change.kind)] = counts[toString(change.kind)].get<int>() + 1;
  }
  const Json json{{"a", mapJson(a)},
                  {"b", mapJson(b)},
                  {"transform", matrixJson(toIsometry(a_T_b).matrix())},
                  {"counts", counts},
                  {"changes", list}};
  // Paths and labels may be no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string diffCsv(std::span<const Change> changes) {
  std::string text = "change,node_a,node_b,label,x,y,z,yaw,pitch,roll,score,px,py,pz,carried,detail\n";
  for (const Change& change : changes) {
    std::string line = toString(change.kind) + "," + (change.node_a ? idText(change.node_a) : "") + "," +
                       (change.node_b ? idText(change.node_b) : "") + "," + csvField(change.label.name);
    if (change.kind == ChangeKind::moved) {
      for (const double value : sixNumbers(change.motion)) appendNumber(line, value);
    } else {
      line += ",,,,,,";
    }
    appendNumber(line, change.score);
    appendVector(line, change.position);
    line += ',';
    for (const auto& [a, b] : change.carried) {
      line += (line.back() == ',' ? "" : " ") + idText(a) + ">" + idText(b);
    }
    text += line + "," + csvField(change.detail) + "\n";
  }
  return text;
}

}  // namespace hoctomap
