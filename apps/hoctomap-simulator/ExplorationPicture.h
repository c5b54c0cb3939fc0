// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/exploration/Explorer.h"

namespace hoctomap {

/// A view from above of what an exploration did, as Fig. 7b: candidate viewpoints as discs, the chosen ones
/// as arrows with their numbers, the way between them, over the last traversability map and the outlines of
/// the tables.
class ExplorationPicture {
 public:
  void add(const ExplorationStep& step);
  /// The script that makes gnuplot draw it, as PNG on its standard output.
  [[nodiscard]] std::string script(const MapHierarchy& map) const;
  /// @throws FileError if gnuplot is not installed or fails, or the file cannot be written.
  void draw(const MapHierarchy& map, const std::filesystem::path& file) const;

 private:
  std::vector<Viewpoint> candidates_;
  std::vector<Viewpoint> chosen_;
  std::vector<std::vector<Eigen::Vector2d>> paths_;
  std::optional<TraversabilityMap> traversability_;
};

}  // namespace hoctomap
