// SPDX-License-Identifier: BSD-3-Clause
// What the machine can do at most.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>

#include "hoctomap/geometry/Errors.h"
#include "measuring/Tasks.h"

namespace hoctomap {

namespace {

constexpr std::size_t kBytes = std::size_t{256} << 20;
constexpr std::size_t kPage = 4096;
constexpr int kRepeats = 3;

struct Free {
  void operator()(void* p) const { std::free(p); }
};
using Memory = std::unique_ptr<std::uint64_t, Free>;

Memory allocate() {
  Memory memory(static_cast<std::uint64_t*>(std::malloc(kBytes)));  // not touched, unlike a vector's
  if (!memory) throw LimitError("no memory to measure with");
  return memory;
}

/// GB/s of the fastest of some passes over the memory.
template <class Pass>
double fastest(const Pass& pass) {
  double best = 0.0;
  for (int i = 0; i < kRepeats; ++i) {
    const Stopwatch watch;
    pass();
    best = std::max(best, 1e-9 * static_cast<double>(kBytes) / watch.elapsed().cpu_s);
  }
  return best;
}

}  // namespace

Figures measureMachine(const Task&) {
  const double fresh = fastest([] {
    const Memory memory = allocate();
    volatile std::uint64_t* const words = memory.get();
    for (std::size_t i = 0; i < kBytes / sizeof(std::uint64_t); i += kPage / sizeof(std::uint64_t))
      words[i] = 1;
  });
  const Memory memory = allocate();
  std::uint64_t* const begin = memory.get();
  std::uint64_t* const end = begin + kBytes / sizeof(std::uint64_t);
  std::memset(begin, 1, kBytes);
  volatile std::uint64_t sink = 0;
  Figures figures;
  figures.add("memset_gb_s", fastest([&] {
                std::memset(begin, static_cast<int>(sink & 1U), kBytes);
                sink = end[-1];
              }));
  figures.add("read_gb_s", fastest([&] { sink = std::accumulate(begin, end, std::uint64_t{0}); }));
  figures.add("read_modify_write_gb_s", fastest([&] {
                std::for_each(begin, end, [](std::uint64_t& word) { word |= word << 1U; });
                sink = end[-1];
              }));
  figures.add("first_touch_gb_s", fresh);
  return figures;
}

}  // namespace hoctomap
