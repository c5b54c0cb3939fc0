// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "ProcessGuards.h"

// The allocation functions of this program, in place of those of the C++ library and of MRPT's core library.
// MRPT sizes its vectors by counts that it reads from the log; and its aligned allocator, which returns null
// when memory is short, lets the caller write through it. Both throw here, so that a hostile count ends as an
// exception.

namespace {

// Allocation functions take no context: one value for the process.
std::atomic<std::size_t> allocation_ceiling{SIZE_MAX};

}  // namespace

namespace hoctomap {

void setAllocationCeiling(std::size_t bytes) {
  allocation_ceiling = bytes;
}

}  // namespace hoctomap

#ifndef HOCTOMAP_SANITIZED  // which brings its own

void* operator new(std::size_t bytes) {
  if (bytes > allocation_ceiling) throw std::bad_alloc();
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace mrpt {

void* aligned_malloc(std::size_t bytes, std::size_t alignment);
void* aligned_malloc(std::size_t bytes, std::size_t alignment) {
  if (bytes > allocation_ceiling) throw std::bad_alloc();
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;  // as aligned_alloc demands
  void* memory = std::aligned_alloc(alignment, rounded);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
  return memory;
}

}  // namespace mrpt

#endif
