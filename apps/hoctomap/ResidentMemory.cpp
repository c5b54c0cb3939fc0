// SPDX-License-Identifier: BSD-3-Clause
#include "ResidentMemory.h"

#include <fstream>
#include <string>

namespace hoctomap {

ResidentMemory residentMemory() {
  ResidentMemory memory;
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key; std::getline(status, key)) {
    constexpr std::size_t kUnit = 1024;
    std::size_t* const bytes = key == "VmRSS:" ? &memory.bytes : key == "VmHWM:" ? &memory.peak : nullptr;
    if (bytes != nullptr && status >> *bytes) *bytes *= kUnit;
  }
  return memory;
}

}  // namespace hoctomap
