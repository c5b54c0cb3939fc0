// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/ProcessMemory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

/// The value of `key:` in a file of /proc, whose unit is kB.
std::uint64_t procBytes(const char* file, const std::string& key) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  }
  throw FileError(std::string(file) + ": no " + key);
}

void setLimit(__rlimit_resource resource, std::uint64_t value) {
  if (value == 0) return;
  const rlimit limit{value, value};
  if (setrlimit(resource, &limit) != 0) throw LimitError("the limits of the process cannot be set");
}

}  // namespace

std::uint64_t availableMemory() {
  return procBytes("/proc/meminfo", "MemAvailable");
}

MemoryPeak::MemoryPeak() {
  malloc_trim(0);
  // Sets the highest point back to the present.
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
  before_ = procBytes("/proc/self/status", "VmRSS");
}

std::uint64_t MemoryPeak::growth() const {
  const std::uint64_t peak = procBytes("/proc/self/status", "VmHWM");
  return peak > before_ ? peak - before_ : 0;
}

void limitThisProcess(const ProcessLimits& limits) {
#ifndef HOCTOMAP_SANITIZED  // which takes far more address space than memory
  setLimit(RLIMIT_AS, limits.memory_bytes);
#endif
  setLimit(RLIMIT_CPU, limits.cpu_seconds);
}

}  // namespace hoctomap
