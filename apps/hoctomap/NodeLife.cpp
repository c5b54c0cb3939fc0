// SPDX-License-Identifier: BSD-3-Clause
#include "NodeLife.h"

#include <algorithm>

#include "hoctomap/config/Settings.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

constexpr double kRounding = 1e-9;

std::string idText(NodeId id) {
  return std::to_string(id.value);
}

const NodeRecord* findRecord(const Manifest& manifest, NodeId id) {
  if (const NodeRecord* record = manifest.find(id)) return record;
  const auto& removed = manifest.removed;
  const auto found =
      std::find_if(removed.begin(), removed.end(), [id](const NodeRecord& r) { return r.id == id; });
  return found == removed.end() ? nullptr : &*found;
}

double priorOf(const std::filesystem::path& directory, const Manifest& manifest, const Label& label) {
  try {
    const Settings settings = loadSettings(directory / manifest.config.path);
    const auto profile = settings.labels.find(label);
    if (profile != settings.labels.end()) return profile->second.existence.prior;
  } catch (const ConfigError&) {
    // Of another version; the node's life can be told all the same.
  }
  return ExistenceParameters{}.prior;
}

}  // namespace

double NodeLife::firstExistence() const {
  const auto created = std::find_if(events.begin(), events.end(), [](const EventRow& e) {
    return e.event == "created" || e.event == "split";
  });
  return created == events.end() ? record.existence : created->existence;
}

NodeLife readNodeLife(const std::filesystem::path& directory, const Manifest& manifest, NodeId node) {
  const NodeRecord* record = findRecord(manifest, node);
  if (record == nullptr) {
    throw MapError(directory.string() + ": after " + std::to_string(manifest.scans) +
                   " scans there is no node " + idText(node) + ", and never was (hoctomap info lists them)");
  }
  NodeLife life;
  life.record = *record;
  life.in_map = manifest.find(node) != nullptr;
  life.prior = priorOf(directory, manifest, record->label);
  const std::string into = "into node " + idText(node);
  for (EventRow& row : readEvents(directory, manifest)) {
    if (row.node == node) {
      life.events.push_back(std::move(row));
    } else if (row.event == "merged" && row.detail == into) {
      life.absorbed.push_back(std::move(row));
    }
  }
  for (const ExistenceRow& row : readExistence(directory, manifest)) {
    if (row.node == node) life.evidence.push_back(row);
  }
  return life;
}

std::string verdict(const ExistenceRow& row, double prior) {
  if (row.p_measurement > prior + kRounding) return "there";
  if (row.p_measurement < prior - kRounding) return "not there";
  return row.occluded > row.present + row.absent ? "hidden" : "too little to say";
}

std::string whyGone(const NodeLife& life) {
  if (life.in_map) return {};
  const auto last = std::find_if(life.events.rbegin(), life.events.rend(), [](const EventRow& e) {
    return e.event == "removed" || e.event == "merged";
  });
  if (last == life.events.rend()) return "not recorded";
  if (last->event == "merged") return "it turned out to be a piece of another node: merged " + last->detail;
  // The scans in a row that brought it down.
  std::vector<std::string> scans;
  std::uint64_t absent = 0;
  std::uint64_t beams = 0;
  for (auto row = life.evidence.rbegin(); row != life.evidence.rend(); ++row) {
    if (row->p_measurement > life.prior + kRounding) break;
    if (row->p_measurement > life.prior - kRounding) continue;
    scans.insert(scans.begin(), std::to_string(row->scan));
    absent += row->absent;
    beams += row->present + row->absent;
  }
  std::string text = last->detail;
  if (scans.empty()) return text;
  text += scans.size() == 1 ? ": scan " : ": scans ";
  for (std::size_t i = 0; i < scans.size(); ++i) text += (i > 0 ? ", " : "") + scans[i];
  return text + " saw through it (" + std::to_string(absent) + " of " + std::to_string(beams) +
         " beams that should have met it ended beyond)";
}

}  // namespace hoctomap
