// SPDX-License-Identifier: BSD-3-Clause
#include "random_map.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace hoctomap::test {
namespace {

void addVoxels(Rng& rng, octomap::OcTree& tree, int count) {
  const double extent = 12.0 * tree.getResolution();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f p = uniformVector(rng, -extent, extent).cast<float>();
    tree.updateNode(octomap::point3d(p.x(), p.y(), p.z()), p.z() < 0.0F || rng() % 4 == 0);
  }
  tree.updateInnerOccupancy();
  tree.prune();
}

}  // namespace

NodeMap randomNodeMap(Rng& rng, double resolution, const OccupancyModel& model) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  model.applyTo(*tree);
  addVoxels(rng, *tree, 150);
  return {std::move(tree), model};
}

MapHierarchy randomHierarchy(Rng& rng, std::size_t nodes) {
  MapHierarchy hierarchy(labels::background, randomNodeMap(rng, 0.05));
  OccupancyModel model;
  model.prob_hit = 0.83;
  model.clamping_max = 0.99;
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto parents = hierarchy.ids();
    const NodeId parent = parents[rng() % parents.size()];
    const bool table = i % 3 == 0;
    const NodeId id =
        hierarchy.add(table ? labels::table : labels::object,
                      randomNodeMap(rng, table ? 0.01 : 0.1 / 48.0, model), randomPose(rng, 3.0), parent);
    MapNode& node = hierarchy.node(id);
    node.existence_log_odds = uniform(rng, 0.1, 3.4);
    node.first_scan = i;
    node.last_scan = i + 2;
    node.version = i + 2;
  }
  return hierarchy;
}

void changeNode(Rng& rng, MapHierarchy& hierarchy, NodeId id, std::uint64_t scan) {
  MapNode& node = hierarchy.node(id);
  auto tree = std::make_unique<octomap::OcTree>(node.map().tree());
  addVoxels(rng, *tree, 20);
  node.map() = NodeMap(std::move(tree), node.map().model());
  node.last_scan = scan;
  node.version = scan;
}

UpdateReport reportOf(const MapHierarchy& hierarchy, NodeId id, std::uint64_t scan) {
  UpdateReport report;
  report.scan = scan;
  report.stamp = 1290000000.25 + static_cast<double>(scan);
  const MapNode& node = hierarchy.node(id);
  report.events.push_back(
      {NodeEventKind::updated, id, node.label(), node.existence(), "a \"detail\", quoted"});
  report.existence.push_back({id, {40, 2, 7, true, 0.875}, node.existence()});
  return report;
}

TemporaryFolder::TemporaryFolder() {
  // In memory if possible: the tests sync thousands of files, and what they ask is not the disk.
  const bool memory = std::getenv("TMPDIR") == nullptr && ::access("/dev/shm", W_OK | X_OK) == 0;
  const std::filesystem::path parent = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
  std::string name = (parent / "hoctomap-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string readText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  return std::move(text).str();
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::map<std::string, std::string> contents(const std::filesystem::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string name = std::filesystem::relative(entry.path(), directory).string();
    if (entry.is_regular_file() && name != "timing.csv" && name != "log.txt") {
      files.emplace(name, readText(entry.path()));
    }
  }
  return files;
}

MapDirectoryOptions mapOptions(MapOpenMode mode) {
  MapDirectoryOptions options;
  options.mode = mode;
  options.config = "[mapping]\nassociation_margin = 0.01\n";
  options.generator = "hoctomap test";
  return options;
}

}  // namespace hoctomap::test
