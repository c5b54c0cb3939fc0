// SPDX-License-Identifier: BSD-3-Clause
#include "build_run.h"

#include <gtest/gtest.h>

#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap::test {

void BuildRun::change() {
  const std::uint64_t scan = scans_++;
  if (scan > 0) {
    changeNode(rng_, hierarchy_, NodeId{2}, 10 * scan);
    hierarchy_.add(labels::object, randomNodeMap(rng_, 0.002), randomPose(rng_, 1.0), kRootId);
  }
  if (scan == 2) {
    const Pose pose = hierarchy_.world_T_node(NodeId{1});
    removed_.push_back({hierarchy_.remove(NodeId{1}), pose, scan});
  }
}

void BuildRun::commit(MapDirectory& writer) {
  change();
  const std::uint64_t scan = scans_ - 1;
  writer.append(reportOf(hierarchy_, NodeId{2}, scan));
  const auto x = static_cast<double>(scan);
  writer.append(ScanRow{scan, x, "a, b", 1000, Pose(x, 2.0, 3.0), 1.0, 0.75, {}});
  writer.append(TimingRow{scan, 1000, 0.5, {}, 0.25});
  writer.commit({hierarchy_, removed_, scans_, "log", scan == 1});
}

void BuildRun::scene(MapDirectory& writer) {
  writer.writeScene([](const auto&, const auto& file) { writeText(file, "a scene"); });
}

void BuildRun::all(MapDirectory& writer) {
  for (int i = 0; i < 3; ++i) commit(writer);
  scene(writer);
}

void BuildRun::end(MapDirectory& writer) {
  UpdateReport report = reportOf(hierarchy_, NodeId{2}, scans_ - 1);
  report.existence.clear();
  writer.appendEnd(report);
  writer.commit({hierarchy_, removed_, scans_, "log"});
  scene(writer);
}

void BuildRun::log(MapDirectory& writer, std::uint64_t scans) {
  while (scans_ < scans) commit(writer);
  end(writer);
}

void BuildRun::skip(std::uint64_t done) {
  for (std::uint64_t i = 0; i < done; ++i) change();
  // What the map has removed already is in its manifest, not in the hands of this session.
  if (done == 3) removed_.clear();
}

void BuildRun::finish(MapDirectory& writer, std::uint64_t seed) {
  BuildRun run(seed);
  run.skip(writer.committed() ? writer.committed()->scans : 0);
  while (run.scans_ < 3) run.commit(writer);
  scene(writer);
}

void BuildRun::finishLog(MapDirectory& writer, std::uint64_t seed) {
  BuildRun run(seed);
  run.skip(writer.committed() ? writer.committed()->scans : 0);
  run.log(writer, 3);
}

void editMap(MapDirectory& writer) {
  const Manifest before = *writer.committed();
  if (before.edits == 0) {
    MapReadOptions all;
    all.to_edit = true;
    StoredMap stored = readMap(writer.path(), all);
    Rng rng(1);
    MapNode& node = stored.hierarchy.node(NodeId{2});
    changeNode(rng, stored.hierarchy, NodeId{2}, node.version);
    node.edition = 1;
    UpdateReport report = reportOf(stored.hierarchy, NodeId{2}, before.scans - 1);
    report.existence.clear();
    writer.append(report);
    writer.commit({stored.hierarchy, {}, before.scans, before.input});
  }
  BuildRun::scene(writer);
}

void expectWholeMap(const std::filesystem::path& map, const std::string& when) {
  const StoredMap stored = readMap(map);
  for (const Damage& damage : findDamage(map, stored.manifest)) ADD_FAILURE() << when << ": " << damage.what;
}

}  // namespace hoctomap::test
