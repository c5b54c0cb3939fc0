// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measuring/Figures.h"
#include "measuring/ProcessMemory.h"
#include "measuring/Scans.h"

namespace hoctomap {

/// One measurement. It is taken in a process of its own, so that neither the heap nor the threads of an
/// earlier one have a part in it.
struct Task {
  std::string name;     ///< one of the functions below
  std::string variant;  ///< whose update
  ScanChoice scans;
  std::optional<std::string> config;   ///< INI; nothing: the built-in one
  std::vector<std::string> overrides;  ///< `section.key=value`
  double resolution = 0.01;            ///< m, for `whole` and `boxes`
  int threads = 1;
  std::size_t far_nodes = 0;  ///< for `mapping`: nodes that the map has already, out of view
  std::size_t warm_up = 0;    ///< for `mapping`: first scans that are mapped but not measured
  ProcessLimits limits;
  bool plain_allocator = false;  ///< the C library's instead of hoctomap's
};

/// `whole`: whole scans into one unbounded map. Variants `stock` and `ours`.
/// Figures: scans, points, user_s, cpu_s, wall_s, map_bytes, leaves, rss_before_bytes, peak_bytes, ot_sha256.
[[nodiscard]] Figures measureWhole(const Task& task);

/// `cells`: how many cells the beams of the same scans visit, and how many updates that makes.
[[nodiscard]] Figures measureCells(const Task& task);

/// `boxes`: the objects of the scans, each map in its box, as they come in mapping at `resolution`. Variants
/// `stock` (key sets, then filter), `filtering` (filter on the way) and `ours`.
[[nodiscard]] Figures measureBoxes(const Task& task);

/// `mapping`: the whole of HierarchyMapper::integrate, without reading and writing. Stages in CPU seconds:
/// the share of the stage in the wall time of a scan, of the CPU time of that scan.
[[nodiscard]] Figures measureMapping(const Task& task);

/// `machine`: what the memory of this machine does, in GB/s, one thread: memset, read, read-modify-write in
/// memory that is mapped already, and one word a page in fresh memory.
[[nodiscard]] Figures measureMachine(const Task& task);

/// The measurement that the task names. @throws ConfigError if there is none of that name
[[nodiscard]] Figures measure(const Task& task);

}  // namespace hoctomap
