// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>

#include "hoctomap/io/LogReadOptions.h"

namespace hoctomap {

namespace {

template <class Number>
std::string text(Number value) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

}  // namespace

std::vector<std::string> toArguments(const LogReadOptions& options) {
  const LogReadOptions defaults;
  std::vector<std::string> arguments{"read"};
  const auto add = [&](const std::string& name, const std::string& value) {
    arguments.push_back("--" + name + "=" + value);
  };
  for (const auto& log : options.logs) add("input", log.string());
  if (!options.poses.empty()) add("poses", options.poses);
  if (!options.pose_label.empty()) add("pose-label", options.pose_label);
  add("max-gap", text(options.max_gap_s));
  if (options.up != defaults.up)
    add("up", text(options.up.x()) + "," + text(options.up.y()) + "," + text(options.up.z()));
  for (const auto& sensor : options.sensors) add("sensor", sensor);
  if (options.start != 0) add("start", text(options.start));
  if (options.end) add("end", text(*options.end));
  if (options.every != 1) add("every", text(options.every));
  if (options.max_scans) add("max-scans", text(*options.max_scans));
  if (options.resume_at != 0) add("resume-at", text(options.resume_at));
  if (options.sample_pairs != 0) add("sample-pairs", text(options.sample_pairs));
  if (options.salvage) arguments.emplace_back("--salvage");
  add("max-inflated-bytes", text(options.max_inflated_bytes));
  add("max-ratio", text(options.max_ratio));
  add("ratio-free-bytes", text(options.ratio_free_bytes));
  add("max-object-bytes", text(options.max_object_bytes));
  add("address-space-bytes", text(options.address_space_bytes));
  return arguments;
}

}  // namespace hoctomap
