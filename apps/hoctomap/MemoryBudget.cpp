// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryBudget.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

constexpr double kMegabyte = 1e6;

std::size_t nineTenthsOfTheMachine() {
  const auto pages = static_cast<std::size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  return pages / 10 * 9 * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Allocations fail from here on. What is reserved ahead of its use counts, hence more than the budget.
void limitAllocation([[maybe_unused]] std::size_t bytes) {
#ifndef HOCTOMAP_SANITIZED  // which reserves terabytes
  constexpr std::size_t kReserved = std::size_t{2} << 30;
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(bytes + kReserved, limit.rlim_cur);
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

std::string megabytes(std::size_t bytes) {
  return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

}  // namespace

MemoryBudget::MemoryBudget(double megabytes)
    : budget_(megabytes < 0.0 ? nineTenthsOfTheMachine() : static_cast<std::size_t>(megabytes * kMegabyte)),
      before_(residentMemory()) {
  limitAllocation(budget_);
}

void MemoryBudget::requireRoom(std::uint64_t scan) {
  const ResidentMemory now = residentMemory();
  // What a scan gave back before its end counts as well. One that stayed below the highest point so far has
  // shown nothing new.
  if (now.peak > before_.peak)
    largest_growth_ = std::max(largest_growth_, now.peak - std::min(now.peak, before_.bytes));
  before_ = now;
  if (now.bytes + largest_growth_ <= budget_) return;
  throw LimitError("scan " + std::to_string(scan) + ": the program holds " + megabytes(now.bytes) +
                   " and may need up to " + megabytes(largest_growth_) +
                   " for a scan, more than its budget of " + megabytes(budget_) + " ([limits] max_memory)");
}

}  // namespace hoctomap
