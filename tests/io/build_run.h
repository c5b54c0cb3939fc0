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
  /// The commits that a map does not have yet, and the scene.
  static void finish(MapDirectory& writer, std::uint64_t seed);

 private:
  void change();

  Rng rng_;
  MapHierarchy hierarchy_;
  std::vector<RemovedNode> removed_;
  std::uint64_t scans_ = 0;
};

/// The map of a directory can be read, and every file is as the manifest says.
void expectWholeMap(const std::filesystem::path& map, const std::string& when);

}  // namespace hoctomap::test
