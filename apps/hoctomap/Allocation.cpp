// SPDX-License-Identifier: BSD-3-Clause
// Memory comes from mimalloc: trees are many small nodes, which it packs tightly and hands out fast. Its own
// operator new ends the program where there is no more memory; ours throws, so that the user gets exit
// code 6. Shared libraries find these, too.
#include <mimalloc.h>

#include <new>

namespace {

void* orThrow(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// What a scan frees the next one takes again: giving it back to the system in between costs more than the
/// work that it was for.
const bool kept_between_scans = [] {
  constexpr long kMilliseconds = 1000;
  mi_option_set(mi_option_decommit_delay, kMilliseconds);
  return true;
}();

}  // namespace

void* operator new(std::size_t bytes) {
  return orThrow(mi_malloc(bytes));
}
void* operator new[](std::size_t bytes) {
  return orThrow(mi_malloc(bytes));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return orThrow(mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment)));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return orThrow(mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment)));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return mi_malloc(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return mi_malloc(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return mi_malloc_aligned(bytes, static_cast<std::size_t>(alignment));
}

void operator delete(void* memory) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
  mi_free(memory);
}
