// SPDX-License-Identifier: BSD-3-Clause
#include "BuildEstimate.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "MappingSetup.h"
#include "TextTable.h"

namespace hoctomap {

namespace {

/// Enough to see how a map grows, and a second or two of work.
constexpr std::uint64_t kPairs = 6;

// What the program takes for itself and for each byte of octrees, measured (docs/scaling.md).
constexpr double kProgramBytes = 130e6;      // program and helper, without a map
constexpr double kHeldPerMapByte = 4.0;      // the map, its copies for files, and the scene in the helper
constexpr double kHeldPerPoint = 100.0;      // scans on their way
constexpr double kWrittenPerMapByte = 0.23;  // node files and scene
constexpr double kWrittenPerScan = 1000.0;   // rows of the tables
constexpr double kStartSeconds = 0.25;       // program and helpers, first and last commit
constexpr double kWriteSecondsPerMapByte = 8e-9;  // files and scene

double cpuSeconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Nodes that have been removed stay in memory, and their files in the map.
double mapBytes(const HierarchyMapper& mapper) {
  std::size_t bytes = 0;
  const auto add = [&bytes](const MapNode& node) { bytes += node.map().tree().memoryUsage(); };
  for (const NodeId id : mapper.hierarchy().ids()) add(mapper.hierarchy().node(id));
  for (const RemovedNode& removed : mapper.removed()) add(removed.node);
  return static_cast<double>(bytes);
}

/// How the surface that has been seen grows with the number of scans. It is counted in cells, because octrees
/// also grow by noise, which has an end.
class SeenSurface {
 public:
  /// The scans of the sample come in pairs of neighbours.
  void add(const PointCloud& world_points) {
    const std::size_t scan = scans_++;
    const Stage stage = scan % 2 == 1 ? followers : scan % 4 == 0 ? half : heads;
    for (const auto& p : world_points) {
      const auto [cell, is_new] = first_seen_.try_emplace(cellOf(p), stage);
      if (!is_new) cell->second = std::min(cell->second, stage);
    }
  }

  /// By how much more there will be after `scans` than after the sample, as a factor. Two bounds, each close
  /// for logs of one kind: where the sensor goes on to new places, every scan adds what a scan adds to its
  /// neighbour; where it comes back to the same places, twice as many scans spread over the log make it
  /// larger by a power.
  [[nodiscard]] double growth(double scans) const {
    const auto sampled = static_cast<double>(scans_);
    if (scans <= sampled || first_seen_.empty()) return 1.0;
    std::array<double, 3> seen{};  // first in this stage
    for (const auto& [cell, stage] : first_seen_) seen.at(stage) += 1.0;
    const double of_heads = seen[half] + seen[heads];
    const double all = of_heads + seen[followers];
    const double by_rate = all + 2.0 * seen[followers] / sampled * (scans - sampled);
    const double by_power = of_heads * std::pow(2.0 * scans / sampled, std::log2(of_heads / seen[half]));
    return std::max(1.0, std::min(by_rate, by_power) / all);
  }

 private:
  /// In the first scan of every other pair, in that of the pairs between, in a second one.
  enum Stage : std::uint8_t { half, heads, followers };

  static std::uint64_t cellOf(const Eigen::Vector3f& p) {
    constexpr float kCell = 0.1F;  // m: above the noise of sensors, below what two scans share
    std::uint64_t key = 0;
    for (const float x : {p.x(), p.y(), p.z()}) {
      const float number = std::floor(std::clamp(x / kCell, -1e6F, 1e6F));
      key = key << 21U | (static_cast<std::uint64_t>(std::llround(number)) & 0x1fffffU);
    }
    return key;
  }

  std::size_t scans_ = 0;
  std::unordered_map<std::uint64_t, Stage> first_seen_;
};

std::uint64_t rounded(double value) {
  return static_cast<std::uint64_t>(std::llround(value));
}

}  // namespace

BuildEstimate estimateBuild(const Settings& settings, LogReadOptions read,
                            const PipeSource::WarningSink& warn) {
  read.sample_pairs = kPairs;
  BuildEstimate estimate;
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, makeStrategies(settings));
  SeenSurface seen;
  double mapped = 0.0;
  double points = 0.0;
  double largest = 0.0;
  const double start = cpuSeconds(RUSAGE_SELF);
  {
    PipeSource source(read, RangeLimits{settings.sensor.min_range}, warn);
    estimate.scans = source.header().chosen_scans;
    while (const auto item = source.next()) {
      if (std::holds_alternative<ObjectMotion>(*item)) continue;
      ++estimate.sampled_scans;
      const auto* z = std::get_if<Measurement>(&*item);
      if (z == nullptr) continue;
      mapper.integrate(*z);
      seen.add(z->world_points);
      mapped += 1.0;
      points += static_cast<double>(z->world_points.size());
      largest = std::max(largest, static_cast<double>(z->world_points.size()));
    }
  }
  const double each = static_cast<double>(estimate.scans) /
                      static_cast<double>(std::max<std::uint64_t>(1, estimate.sampled_scans));
  const double map = mapBytes(mapper) * seen.growth(each * mapped);
  estimate.points = rounded(each * points);
  estimate.map_bytes = rounded(map);
  estimate.peak_memory_bytes = rounded(kProgramBytes + kHeldPerMapByte * map + kHeldPerPoint * largest);
  estimate.cpu_s = kStartSeconds + cpuSeconds(RUSAGE_CHILDREN) + each * (cpuSeconds(RUSAGE_SELF) - start) +
                   kWriteSecondsPerMapByte * map;
  estimate.disk_bytes =
      rounded(kWrittenPerMapByte * map + kWrittenPerScan * static_cast<double>(estimate.scans));
  return estimate;
}

std::string BuildEstimate::text() const {
  const auto megabytes = [](std::uint64_t bytes) {
    return fixedText(1e-6 * static_cast<double>(bytes), 0) + " MB";
  };
  return "scans      " + std::to_string(scans) + " (judged by " + std::to_string(sampled_scans) + ")\n" +
         "points     " + fixedText(1e-6 * static_cast<double>(points), 1) + " million\n" + "memory     " +
         megabytes(peak_memory_bytes) + " at its peak, " + megabytes(map_bytes) + " of it octrees\n" +
         "time       " + fixedText(cpu_s, 0) + " s of CPU\n" + "disk       " + megabytes(disk_bytes) + "\n";
}

std::string BuildEstimate::json() const {
  const nlohmann::ordered_json json{
      {"scans", scans},          {"sampled_scans", sampled_scans},         {"points", points},
      {"map_bytes", map_bytes},  {"peak_memory_bytes", peak_memory_bytes}, {"cpu_s", cpu_s},
      {"disk_bytes", disk_bytes}};
  return json.dump(2) + "\n";
}

}  // namespace hoctomap
