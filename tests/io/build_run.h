// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "random_map.h"

namespace hoctomap::test {

/// A run of three commits that changes, adds and removes nodes; the same every time.
class BuildRun {
 public:
  explicit BuildRun(std::uint64_t seed) : rng_(seed), hierarchy_(randomHierarchy(rng_, 2)) {}

  /// What the next scan does, and its commit.
  void commit(MapDirectory& writer);
  static void scene(MapDirectory& writer);
  /// Three commits and the scene.
  void all(MapDirectory& writer);
  /// So many commits, the end of the log, which adds an event that a longer log takes back, and the scene.
  void log(MapDirectory& writer, std::uint64_t scans);
  /// Goes on with what `log` began, or nothing did, until the log of three scans has ended.
  static void finishLog(MapDirectory& writer, std::uint64_t seed);
  /// The commits that a map does not have yet, and the scene.
  static void finish(MapDirectory& writer, std::uint64_t seed);

 private:
  void change();
  /// The first `done` scans are in a map already.
  void skip(std::uint64_t done);
  void end(MapDirectory& writer);

  Rng rng_;
  MapHierarchy hierarchy_;
  std::vector<RemovedNode> removed_;
  std::uint64_t scans_ = 0;
};

/// An edit by hand that changes the octree of a node, and the scene; the scene alone if the map has the edit.
void editMap(MapDirectory& writer);

/// The map of a directory can be read, and every file is as the manifest says.
void expectWholeMap(const std::filesystem::path& map, const std::string& when);

}  // namespace hoctomap::test
