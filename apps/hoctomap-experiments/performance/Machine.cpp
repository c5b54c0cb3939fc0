// SPDX-License-Identifier: BSD-3-Clause
#include "performance/Machine.h"

#include <fstream>
#include <thread>

#include "measuring/ProcessMemory.h"

namespace hoctomap {

namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string load() {
  std::ifstream in("/proc/loadavg");
  std::string one_minute;
  in >> one_minute;
  return one_minute;
}

}  // namespace

std::string describeMachine(const Figures& bandwidth) {
  const auto rate = [&](const char* name) { return numberText(bandwidth.number(name), 3) + " GB/s"; };
  return "- " + processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads, " +
         numberText(1e-9 * static_cast<double>(availableMemory()), 3) + " GB of memory available, load " +
         load() + " at the end of the run\n- one thread: memset " + rate("memset_gb_s") + ", read " +
         rate("read_gb_s") + ", read-modify-write " + rate("read_modify_write_gb_s") +
         ", first touch of fresh memory " + rate("first_touch_gb_s") + "\n";
}

std::string describeBound(const std::string& name, const Figures& cells, const Figures& ours,
                          const Figures& bandwidth) {
  const double seconds = ours.number("cpu_s");
  const double map_gb = 1e-9 * ours.number("map_bytes");
  const double scans = ours.number("scans");
  // A scan cannot but read and write the voxels it changes, nearly all of the map when views overlap; and the
  // memory of the map must come from the system once.
  const double warm = scans * map_gb / bandwidth.number("read_modify_write_gb_s");
  const double fresh = map_gb / bandwidth.number("first_touch_gb_s");
  return "- " + name + ": " + numberText(1e-6 * cells.number("visits"), 3) + " M cells on the beams, " +
         numberText(1e-6 * cells.number("updates"), 3) + " M distinct; " + numberText(seconds, 3) +
         " s CPU with the kernel's share, that is " + numberText(1e9 * seconds / cells.number("visits"), 3) +
         " ns a visit, " + numberText(1e9 * seconds / cells.number("updates"), 3) +
         " ns an update. Bound by memory: " + numberText(warm, 2) + " s to go once a scan through a map of " +
         numberText(1e3 * map_gb, 3) + " MB, and " + numberText(fresh, 2) +
         " s to get it from the system once; we are " + numberText(seconds / (warm + fresh), 2) +
         "x above the sum\n";
}

}  // namespace hoctomap
