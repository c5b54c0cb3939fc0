// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measuring/Figures.h"

namespace hoctomap {

/// Ways to map one set of scans, in the order of tables and plots.
enum class MapMethod {
  hierarchy,   ///< the map hierarchy H'
  monolithic,  ///< one map with our update engine
  stock        ///< one map with OctoMap's insertPointCloud: the paper's baseline
};
[[nodiscard]] std::string nameOf(MapMethod method);

/// Where a figure comes from.
enum class Origin {
  measured,
  equal_map,  ///< measured with our engine, which makes the same map to the last byte
  part,       ///< measured on some of the scans, and scaled by the number of points
  law         ///< from the two next coarser resolutions
};
[[nodiscard]] std::string nameOf(Origin origin);

struct Figure {
  double value = 0.0;
  Origin origin = Origin::measured;
};

/// One way to map one set at one object resolution: a point of Fig. 4 and of Fig. 5.
struct Point {
  std::string set;
  double resolution_mm = 0.0;
  MapMethod method = MapMethod::hierarchy;
  std::optional<Figure> seconds;  ///< CPU time to integrate all scans: median of the repeats
  double spread = 0.0;            ///< (longest - shortest) / median of the repeats
  std::optional<Figure> bytes;    ///< of the map: OctoMap's memoryUsage()
  std::size_t runs = 0;           ///< of the whole set
  std::string ot_sha256;          ///< of a monolithic map that was made in full
};

/// A prediction beside what was measured.
struct PredictionCheck {
  std::string set;
  double resolution_mm = 0.0;
  MapMethod method = MapMethod::hierarchy;
  std::string quantity;  ///< seconds or bytes
  Origin way = Origin::law;
  double predicted = 0.0;
  double measured = 0.0;
};

struct ViAResults {
  std::vector<Point> points;
  std::vector<PredictionCheck> checks;
  std::size_t equal_maps = 0;    ///< cases in which stock's map and ours were compared and equal
  std::size_t unequal_maps = 0;  ///< must be 0

  [[nodiscard]] const Point* find(const std::string& set, double resolution_mm, MapMethod method) const;
  [[nodiscard]] std::vector<std::string> sets() const;      ///< in order of appearance
  [[nodiscard]] std::vector<double> resolutionsMm() const;  ///< coarsest first
};

/// `set,resolution_mm,method,seconds,seconds_origin,spread,bytes,bytes_origin,runs`
[[nodiscard]] std::string pointsCsv(const ViAResults& results);
/// `set,resolution_mm,method,quantity,way,predicted,measured,ratio`
[[nodiscard]] std::string checksCsv(const ViAResults& results);
[[nodiscard]] std::string checksMarkdown(const ViAResults& results);
/// Tables in Markdown: memory and time, with ratios. Predicted figures are marked with `~`.
[[nodiscard]] std::string markdownTables(const ViAResults& results);

}  // namespace hoctomap
