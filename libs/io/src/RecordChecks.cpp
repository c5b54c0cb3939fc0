// SPDX-License-Identifier: BSD-3-Clause
#include "RecordChecks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "hoctomap/hierarchy/LogOdds.h"

namespace hoctomap {

bool staysInside(const std::string& path) {
  const auto folders = "/" + path + "/";
  const bool control = std::any_of(path.begin(), path.end(), [](unsigned char c) { return std::iscntrl(c); });
  return !path.empty() && path.front() != '/' && folders.find("/../") == std::string::npos && !control;
}

bool isSha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

const char* problemOf(const NodeRecord& node) {
  const auto isProbability = [](double p) { return p > 0.0 && p < 1.0; };
  const OccupancyModel& model = node.occupancy;
  if (!(node.resolution > 0.0)) return "a resolution is not above 0";
  if (!isProbability(node.existence)) return "an existence is not between 0 and 1";
  if (std::abs(probability(node.existence_log_odds) - node.existence) > 1e-9)
    return "an existence is not that of its log-odds";
  if (!(node.box_half_extents.array() >= 0.0).all()) return "a box has a negative extent";
  if (!isProbability(model.prob_hit) || !isProbability(model.prob_miss) ||
      !isProbability(model.clamping_min) || !isProbability(model.clamping_max) ||
      !isProbability(model.occupancy_threshold) || !(model.clamping_min < model.clamping_max))
    return "a sensor model is impossible";
  for (const FileRecord* file : {&node.ot, &node.bt}) {
    if (!staysInside(file->path)) return "a path leads out of the map directory";
    if (!isSha256(file->sha256)) return "a hash is no SHA-256";
  }
  return nullptr;
}

}  // namespace hoctomap
