// SPDX-License-Identifier: BSD-3-Clause
#include "identity/IdentityRun.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include "MappingSetup.h"
#include "hoctomap/simulation/Simulation.h"
#include "hoctomap/tabletop/LabelImage.h"

namespace hoctomap {

namespace {

using Cell = std::tuple<int, int, int>;

Cell cellOf(const Eigen::Vector3f& p, float size) {
  const auto index = [size](float x) { return static_cast<int>(std::floor(x / size)); };
  return {index(p.x()), index(p.y()), index(p.z())};
}

MappedObject objectOf(const MapHierarchy& map, NodeId id) {
  MappedObject object{id, Eigen::Vector3d::Zero(), {}};
  const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
  for (const auto& voxel : map.node(id).map().occupiedVoxels()) {
    const Eigen::Vector3d p = world_T_node * voxel.cast<double>();
    object.centroid += p;
    object.world_voxels.push_back(p.cast<float>());
  }
  object.centroid /= std::max<double>(1.0, static_cast<double>(object.world_voxels.size()));
  return object;
}

constexpr std::uint16_t kNoNode = 1;  // nodes count from 100

/// Of every point the node that has the nearest voxel within 8 mm.
std::vector<std::uint16_t> nodesOf(const MappedLog& map, const PointCloud& points) {
  constexpr float kNear = 0.008F;  // m
  std::map<Cell, std::vector<std::pair<Eigen::Vector3f, std::uint16_t>>> voxels;
  for (std::size_t n = 0; n < map.objects.size(); ++n) {
    for (const auto& p : map.objects[n].world_voxels)
      voxels[cellOf(p, kNear)].emplace_back(p, static_cast<std::uint16_t>(100 + n));
  }
  std::vector<std::uint16_t> nodes;
  for (const auto& p : points) {
    std::uint16_t node = kNoNode;
    float nearest = kNear * kNear;
    const auto [x, y, z] = cellOf(p, kNear);
    for (int step = 0; step < 27; ++step) {
      const auto found = voxels.find({x + step / 9 - 1, y + step / 3 % 3 - 1, z + step % 3 - 1});
      if (found == voxels.end()) continue;
      for (const auto& [q, n] : found->second) {
        const float distance = (q - p).squaredNorm();
        if (distance < nearest) std::tie(nearest, node) = std::pair(distance, n);
      }
    }
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

std::string toString(ScanOrder order) {
  switch (order) {
    case ScanOrder::forward:
      return "forward";
    case ScanOrder::reverse:
      return "reverse";
    case ScanOrder::shuffled:
      break;
  }
  return "shuffled";
}

std::vector<Measurement> reordered(std::vector<Measurement> scans, ScanOrder order, std::uint64_t seed) {
  std::vector<std::pair<std::uint64_t, double>> places;
  for (const Measurement& z : scans) places.emplace_back(z.scan, z.stamp);
  if (order == ScanOrder::reverse) std::reverse(scans.begin(), scans.end());
  std::mt19937_64 random(seed);
  for (std::size_t i = scans.size(); order == ScanOrder::shuffled && i > 1; --i)
    std::swap(scans[i - 1], scans[random() % i]);
  for (std::size_t i = 0; i < scans.size(); ++i) std::tie(scans[i].scan, scans[i].stamp) = places[i];
  return scans;
}

MappedLog mapScans(const std::vector<Measurement>& scans, const Settings& settings) {
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, makeStrategies(settings));
  MappedLog log;
  const auto note = [&log](const UpdateReport& report) {
    for (const NodeEvent& event : report.events) {
      if (event.kind == NodeEventKind::updated || event.label != labels::object) continue;
      log.events.push_back("scan " + std::to_string(report.scan) + ": " + toString(event.kind) + " " +
                           std::to_string(event.node.value) + " (" + event.detail + ")");
    }
  };
  for (const Measurement& z : scans) note(mapper.integrate(z));
  if (!scans.empty()) note(mapper.finish(scans.back().scan, scans.back().stamp));
  const MapHierarchy& map = mapper.hierarchy();
  for (const NodeId id : map.ids()) {
    if (map.node(id).confirmation.waits) continue;
    if (map.node(id).label() == labels::object) log.objects.push_back(objectOf(map, id));
    log.tables += map.node(id).label() == labels::table;
  }
  return log;
}

SeenScene see(const CrowdedScene& scene) {
  constexpr float kSpacing = 0.004F;  // m
  SeenScene seen;
  std::map<std::pair<std::uint32_t, Cell>, Eigen::Vector3f> surface;
  simulateScene(scene.simulation, 0, [&](const SimulatedScan& scan) {
    Measurement z = unproject(scan.image, scan.world_T_sensor, {});
    z.scan = scan.scan;
    z.stamp = scan.stamp;
    z.sensor = scan.sensor;
    seen.scans.push_back(std::move(z));
    seen.labels.push_back({scan.image.camera.width, scan.image.camera.height, scan.labels});
    for (auto& value : seen.labels.back().values) {
      if (value != label_value::no_return)
        value = value >= label_value::first_object ? static_cast<std::uint16_t>(value - 98) : 1;
    }
    const Measurement exact = unproject(scan.rendering.image, scan.world_T_sensor, {});
    for (std::size_t i = 0; i < exact.world_points.size(); ++i) {
      const auto solid = scan.solids[exact.pixel_of_point[i]];
      if (solid < 0 || solid != scan.rendering.solids[exact.pixel_of_point[i]]) continue;
      const SolidId id{static_cast<std::uint32_t>(solid)};
      if (scan.scene.solid(id).label != SolidLabel::object) continue;
      surface.try_emplace({id.value, cellOf(exact.world_points[i], kSpacing)}, exact.world_points[i]);
    }
  });
  std::map<std::uint32_t, std::uint16_t> numbers;
  for (const auto& [key, point] : surface) {
    const auto number =
        numbers.try_emplace(key.first, static_cast<std::uint16_t>(numbers.size())).first->second;
    seen.world_surface.push_back(point);
    seen.object.push_back(number);
  }
  seen.objects = numbers.size();
  for (const auto& [solid, number] : numbers)
    seen.names.push_back(scene.simulation.scene.solid(SolidId{solid}).name);
  return seen;
}

SegmentationScore scoreViews(const SeenScene& scene, const Segmentation& segmentation) {
  SegmentationScore sum;
  for (std::size_t k = 0; k < scene.scans.size(); ++k) {
    const Measurement& z = scene.scans[k];
    const GreyImage& truth = scene.labels[k];
    sum += scoreSegmentation({truth.width, truth.height, labelImage(z, segmentation.segment(z))}, truth);
  }
  const auto views = std::max(1.0, static_cast<double>(scene.scans.size()));
  for (double* value : {&sum.precision, &sum.recall, &sum.f, &sum.share75, &sum.found, &sum.objects})
    *value /= views;
  return sum;
}

SegmentationScore scoreIdentity(const MappedLog& map, const SeenScene& truth) {
  const auto width = static_cast<int>(truth.world_surface.size());
  const GreyImage found{width, 1, nodesOf(map, truth.world_surface)};
  GreyImage objects{width, 1, {}};
  for (const auto object : truth.object) objects.values.push_back(static_cast<std::uint16_t>(2 + object));
  return scoreSegmentation(found, objects);
}

std::vector<ObjectFate> objectFates(const MappedLog& map, const SeenScene& truth) {
  const std::vector<std::uint16_t> node_of = nodesOf(map, truth.world_surface);
  std::vector<std::map<std::uint16_t, double>> nodes(truth.objects);  // points of every object by node
  std::map<std::uint16_t, std::map<double, std::size_t>> objects_of;  // of every node by their points
  for (std::size_t i = 0; i < node_of.size(); ++i) nodes[truth.object[i]][node_of[i]] += 1.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const auto& [node, points] : nodes[k]) objects_of[node][points] = k;
  }
  const auto ownerOf = [&](std::uint16_t node) { return objects_of.at(node).rbegin()->second; };
  std::vector<ObjectFate> fates;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    ObjectFate fate{truth.names[k], 0.0, 0.0, 0.0, 0.0, 0.0, {}};
    double most = 0.0;
    for (const auto& [node, points] : nodes[k]) {
      fate.points += points;
      if (node == kNoNode) {
        fate.nowhere += points;
      } else if (ownerOf(node) != k) {
        fate.in_another += points;
      } else {
        fate.in_other_half += points;
        fate.found = std::max(fate.found, points);
      }
      if (node == kNoNode || points <= most) continue;
      most = points;
      fate.joined_with = ownerOf(node) == k ? "" : truth.names[ownerOf(node)];
    }
    fate.in_other_half -= fate.found;
    for (double* share : {&fate.found, &fate.in_other_half, &fate.in_another, &fate.nowhere})
      *share /= fate.points;
    fates.push_back(fate);
  }
  return fates;
}

std::size_t matchedObjects(const MappedLog& a, const MappedLog& b, double distance) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    for (std::size_t j = 0; j < b.objects.size(); ++j) {
      const double d = (a.objects[i].centroid - b.objects[j].centroid).norm();
      if (d < distance) pairs.emplace_back(d, i, j);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> taken_a(a.objects.size(), false);
  std::vector<bool> taken_b(b.objects.size(), false);
  std::size_t matched = 0;
  for (const auto& [d, i, j] : pairs) {
    if (taken_a[i] || taken_b[j]) continue;
    taken_a[i] = taken_b[j] = true;
    ++matched;
  }
  return matched;
}

}  // namespace hoctomap
