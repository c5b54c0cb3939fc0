// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/Stopwatch.h"

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace hoctomap {

Elapsed& Elapsed::operator+=(const Elapsed& other) {
  user_s += other.user_s;
  cpu_s += other.cpu_s;
  wall_s += other.wall_s;
  return *this;
}

Elapsed Stopwatch::now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  timespec cpu{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec),
          std::chrono::duration<double>(wall).count()};
}

}  // namespace hoctomap
