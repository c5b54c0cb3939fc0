// SPDX-License-Identifier: BSD-3-Clause
// The function that libFuzzer calls, and the replay program.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "FuzzTarget.h"
#include "hoctomap/geometry/Errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    hoctomap::fuzz::read({reinterpret_cast<const char*>(bytes), size});
  } catch (const hoctomap::Error& error) {
    hoctomap::fuzz::require(*error.what() != '\0', "an error says what is wrong");
  }
  return 0;
}

namespace hoctomap::fuzz {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace hoctomap::fuzz
