// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "NodeLife.h"
#include "TextTable.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

std::string probabilityText(double p) {
  return fixedText(p, 4);
}

std::string stateText(const NodeLife& life) {
  if (life.in_map) return "in the map, existence " + probabilityText(life.record.existence);
  const bool merged = !life.events.empty() && life.events.back().event == "merged";
  return std::string(merged ? "merged" : "removed") + " after scan " +
         std::to_string(life.record.removed_scan.value_or(0)) + ", existence " +
         probabilityText(life.record.existence);
}

std::string line(const std::string& key, const std::string& value) {
  return key + std::string(key.size() < 11 ? 11 - key.size() : 1, ' ') + value + "\n";
}

std::string headText(const NodeLife& life) {
  const NodeRecord& r = life.record;
  std::string text = "node " + std::to_string(r.id.value) + " " + escapedText(r.label.name, 60) + ": " +
                     stateText(life) + "\n\n";
  const auto created = std::find_if(life.events.begin(), life.events.end(),
                                    [](const EventRow& e) { return e.event == "created"; });
  if (created != life.events.end()) {
    text += line("created", "from scan " + std::to_string(created->scan) + ": " +
                                escapedText(created->detail, 200) + "; existence " +
                                probabilityText(created->existence));
  } else {
    text += line("created", r.parent ? "not recorded" : "with the map: it is the root");
  }
  if (r.parent) text += line("parent", std::to_string(r.parent->value));
  std::string children;
  for (const NodeId child : r.children)
    children += (children.empty() ? "" : " ") + std::to_string(child.value);
  if (!children.empty()) text += line("children", children);
  text +=
      line("map", fixedText(1000.0 * r.resolution, 1) + " mm voxels, " + std::to_string(r.voxels.occupied) +
                      " occupied, " + std::to_string(r.voxels.free) + " free; mapped in scans " +
                      std::to_string(r.first_scan) + "-" + std::to_string(r.last_scan));
  const Eigen::Vector3d centre = toIsometry(r.world_T_node) * r.box_center;
  const Eigen::Vector3d size = 2.0 * r.box_half_extents;
  text += line("box", fixedText(size.x(), 3) + " x " + fixedText(size.y(), 3) + " x " +
                          fixedText(size.z(), 3) + " m about " + fixedText(centre.x(), 3) + " " +
                          fixedText(centre.y(), 3) + " " + fixedText(centre.z(), 3));
  const std::string why = whyGone(life);
  if (!why.empty()) text += line("gone", escapedText(why, 1000));
  return text;
}

std::string eventText(const EventRow& event, NodeId self) {
  const std::string detail = event.detail.empty() ? "" : ": " + escapedText(event.detail, 200);
  if (event.node != self) return "took in node " + std::to_string(event.node.value);
  return escapedText(event.event, 40) + detail;
}

struct ScanOfLife {
  const ExistenceRow* evidence = nullptr;
  std::string events;
};

std::map<std::uint64_t, ScanOfLife> scansOf(const NodeLife& life) {
  std::map<std::uint64_t, ScanOfLife> scans;
  for (const ExistenceRow& row : life.evidence) scans[row.scan].evidence = &row;
  for (const auto* list : {&life.events, &life.absorbed}) {
    for (const EventRow& event : *list) {
      std::string& text = scans[event.scan].events;
      text += (text.empty() ? "" : "; ") + eventText(event, life.record.id);
    }
  }
  return scans;
}

Json eventJson(const EventRow& event) {
  return {{"scan", event.scan},       {"time", event.time},           {"event", event.event},
          {"node", event.node.value}, {"existence", event.existence}, {"detail", event.detail}};
}

}  // namespace

std::string lifeText(const NodeLife& life) {
  TextTable table({"scan", "present", "absent", "occluded", "P(n|z)", "P(n|z1:t)", "says", "events"});
  for (const auto& [scan, of] : scansOf(life)) {
    std::vector<std::string> row{std::to_string(scan), "", "", "", "", "", "", of.events};
    if (of.evidence != nullptr) {
      const ExistenceRow& e = *of.evidence;
      row = {std::to_string(scan),
             std::to_string(e.present),
             std::to_string(e.absent),
             std::to_string(e.occluded),
             probabilityText(e.p_measurement),
             probabilityText(e.p_posterior),
             verdict(e, life.prior),
             of.events};
    }
    table.add(std::move(row));
  }
  return headText(life) + "\n" + table.text();
}

std::string lifeJson(const NodeLife& life) {
  const NodeRecord& r = life.record;
  Json events = Json::array();
  for (const EventRow& event : life.events) events.push_back(eventJson(event));
  Json absorbed = Json::array();
  for (const EventRow& event : life.absorbed) absorbed.push_back(eventJson(event));
  Json evidence = Json::array();
  for (const ExistenceRow& row : life.evidence) {
    evidence.push_back({{"scan", row.scan},
                        {"present", row.present},
                        {"absent", row.absent},
                        {"occluded", row.occluded},
                        {"p_measurement", row.p_measurement},
                        {"p_posterior", row.p_posterior},
                        {"says", verdict(row, life.prior)}});
  }
  Json children = Json::array();
  for (const NodeId child : r.children) children.push_back(child.value);
  Json json{{"node", r.id.value},         {"label", r.label.name},
            {"in_map", life.in_map},      {"parent", r.parent ? Json(r.parent->value) : Json(nullptr)},
            {"children", children},       {"resolution", r.resolution},
            {"existence", r.existence},   {"prior", life.prior},
            {"first_scan", r.first_scan}, {"last_scan", r.last_scan}};
  if (r.removed_scan) json["removed_scan"] = *r.removed_scan;
  if (!life.in_map) json["gone"] = whyGone(life);
  json["events"] = events;
  json["absorbed"] = absorbed;
  json["evidence"] = evidence;
  // Labels of a hand-edited map may be no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hoctomap
