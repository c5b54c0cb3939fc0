// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "measuring/Tasks.h"
#include "performance/Table.h"

namespace hoctomap {

struct PerformanceOptions {
  std::filesystem::path log;        ///< the scans to measure with
  std::filesystem::path simulated;  ///< log of a simulated set, for the memory of maps
  std::filesystem::path many;       ///< log of a scene with many objects, for the threads
  std::filesystem::path output;
  int repeats = 3;
  std::uint64_t scans = 2;  ///< of the log, evenly spread, for what is compared with stock
  std::uint64_t scans_of_log = 0;
  std::size_t far_nodes = 100'000;
  double coarsening = 1.0;  ///< of the resolutions compared with stock: above 1 only to see whether all works
};

/// Takes the measurements of the table, each in a process of its own. What is compared is interleaved.
class Comparison {
 public:
  using Say = std::function<void(const std::string&)>;
  Comparison(PerformanceOptions options, Say say);

  /// The rows of the table, in order; `done` gets each as soon as it is there.
  void run(const std::function<void(const TableRow&)>& done);

  /// What bounds the update of whole scans, and how far it is from that; in Markdown.
  [[nodiscard]] std::string bounds();

  /// All figures of all measurements: `measurement,variant,repeat,figure,value`.
  [[nodiscard]] const std::string& csv() const { return csv_; }

 private:
  using Variants = std::vector<std::pair<std::string, Task>>;
  using Runs = std::map<std::string, std::vector<Figures>>;

  [[nodiscard]] Task task(const std::string& name, const std::string& variant) const;
  [[nodiscard]] Task mapping(const std::filesystem::path& log, double object_resolution) const;
  Runs interleaved(const std::string& name, const Variants& variants, int repeats);
  void record(const std::string& name, const std::string& variant, int repeat, const Figures& figures);

  TableRow wholeScans(double resolution, double goal);
  TableRow objectBoxes(double resolution, double goal);
  std::vector<TableRow> againstMonolithic();
  TableRow simulatedMemory();
  TableRow finestObjects();
  TableRow twoThreads();
  TableRow wholeBuild();
  TableRow segmentation();
  TableRow manyNodes();
  TableRow peakOfScan();

  PerformanceOptions options_;
  Say say_;
  std::string csv_;
};

}  // namespace hoctomap
