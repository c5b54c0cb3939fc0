// SPDX-License-Identifier: BSD-3-Clause
#include "TableLogs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numbers>
#include <random>
#include <variant>

#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/io/PipeSource.h"
#include "support/SharedData.h"

namespace hoctomap::test {

std::string scene(const std::string& name) {
  return (sourceDir() / "configs/scenes" / (name + ".ini")).string();
}

void simulate(const std::string& scene_name, const std::string& log,
              const std::vector<std::string>& settings) {
  std::vector<std::string> arguments{"simulate", "-q", "-c", scene(scene_name), "-o", log};
  for (const auto& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  const Outcome outcome = hoctomap(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

Outcome build(const std::string& log, const std::string& map, const std::vector<std::string>& more,
              int expected) {
  std::vector<std::string> arguments{"build", "-q", "-i", log, "-o", map};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Outcome outcome = hoctomap(arguments);
  EXPECT_EQ(outcome.exit_code, expected) << outcome.err;
  return outcome;
}

std::vector<Measurement> scansOf(const std::string& log) {
  setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
  LogReadOptions options;
  options.logs = {log};
  PipeSource source(options, RangeLimits{}, [](const std::string&) {});
  std::vector<Measurement> scans;
  while (auto item = source.next()) {
    if (auto* z = std::get_if<Measurement>(&*item)) scans.push_back(std::move(*z));
  }
  return scans;
}

void addPoseNoise(const std::string& log, const std::string& noisy, double shift, double turn,
                  std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  constexpr double kDegree = std::numbers::pi / 180.0;
  const std::vector<Measurement> scans = scansOf(log);
  PipeLogWriter writer(noisy);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Measurement& z = scans[i];
    const std::array<double, 6> e{normal(random), normal(random), normal(random),
                                  normal(random), normal(random), normal(random)};
    const Pose error(shift * e[0], shift * e[1], shift * e[2], turn * kDegree * e[3], turn * kDegree * e[4],
                     turn * kDegree * e[5]);
    const Pose world_T_sensor = z.world_T_sensor + error;
    writer.write(TruthPose{z.stamp, "groundtruth", world_T_sensor});
    writer.write(DepthScan{i, z.stamp, z.sensor, world_T_sensor, *z.image});
  }
  writer.finish();
}

void reverseLog(const std::string& log, const std::string& reversed) {
  const std::vector<Measurement> scans = scansOf(log);
  PipeLogWriter writer(reversed);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Measurement& z = scans[scans.size() - 1 - i];
    const double stamp = scans[i].stamp;
    writer.write(TruthPose{stamp, "groundtruth", z.world_T_sensor});
    writer.write(DepthScan{i, stamp, z.sensor, z.world_T_sensor, *z.image});
  }
  writer.finish();
}

void copyLog(const std::string& log, const std::string& copy, const ObjectMotion& end) {
  const std::vector<Measurement> scans = scansOf(log);
  PipeLogWriter writer(copy);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Measurement& z = scans[i];
    writer.write(TruthPose{z.stamp, "groundtruth", z.world_T_sensor});
    writer.write(DepthScan{i, z.stamp, z.sensor, z.world_T_sensor, *z.image});
  }
  writer.write(end);
  writer.finish();
}

namespace {

std::array<int, 3> cellOf(const Eigen::Vector3f& p) {
  constexpr float kCell = 0.02F;  // m
  const Eigen::Array3i cell = (p / kCell).array().floor().cast<int>();
  return {cell[0], cell[1], cell[2]};
}

}  // namespace

ShownPlaces::ShownPlaces(const PointCloud& world_points) {
  for (const auto& p : world_points) cells_.insert(cellOf(p));
}

bool ShownPlaces::isNear(const Eigen::Vector3f& world_point) const {
  const auto cell = cellOf(world_point);
  for (int n = 0; n < 27; ++n) {
    if (cells_.contains({cell[0] + n / 9 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n % 3 - 1})) return true;
  }
  return false;
}

std::vector<MappedNode> nodesOf(const std::string& map, const std::string& label) {
  const StoredMap stored = readMap(map);
  std::vector<MappedNode> nodes;
  for (const NodeRecord& record : stored.manifest.nodes) {
    if (record.label.name != label) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    PointCloud voxels = stored.hierarchy.node(record.id).map().occupiedVoxels();
    for (auto& voxel : voxels) {
      voxel = (toIsometry(record.world_T_node) * voxel.cast<double>()).cast<float>();
      sum += voxel.cast<double>();
    }
    const Eigen::Vector3d centroid = sum / static_cast<double>(voxels.size());
    nodes.push_back({record, centroid, std::move(voxels)});
  }
  return nodes;
}

void expectTruth(const std::string& map, const std::string& truth, double tolerance) {
  const auto rows = parseCsv(readFile(std::filesystem::path(truth) / "poses.csv"));
  ASSERT_FALSE(rows.empty());
  const std::string last_scan = rows.back().at("scan");
  const auto number = [](const auto& row, const std::string& key) { return std::stod(row.at(key)); };
  const auto tables = nodesOf(map, "table");
  auto objects = nodesOf(map, "object");
  for (const auto& row : rows) {
    if (row.at("scan") != last_scan || row.at("label") != "object" || row.at("present") != "1") continue;
    const Eigen::Vector3d seen(number(row, "sx"), number(row, "sy"), number(row, "sz"));
    const auto distance = [&](const MappedNode& n) { return (n.centroid - seen).norm(); };
    ASSERT_FALSE(objects.empty()) << row.at("object") << " is missing";
    const auto nearest = std::min_element(objects.begin(), objects.end(), [&](const auto& a, const auto& b) {
      return distance(a) < distance(b);
    });
    EXPECT_LT(distance(*nearest), tolerance) << row.at("object");
    const auto parent = std::find_if(tables.begin(), tables.end(),
                                     [&](const auto& t) { return t.record.id == nearest->record.parent; });
    ASSERT_NE(parent, tables.end()) << row.at("object") << " does not stand on a table";
    for (const auto& table : tables) {
      EXPECT_LE((parent->centroid - seen).norm(), (table.centroid - seen).norm())
          << "another table is nearer";
    }
    objects.erase(nearest);
  }
  for (const auto& spurious : objects) {
    ADD_FAILURE() << "node " << spurious.record.id.value
                  << " is no object: " << spurious.centroid.transpose();
  }
}

}  // namespace hoctomap::test
