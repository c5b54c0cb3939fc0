// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace hoctomap {

/// Writes all bytes; a reader that is gone is an error, never SIGPIPE.
/// @returns 0, or the errno of what failed
[[nodiscard]] int writeToPipe(int fd, const void* bytes, std::size_t count);

}  // namespace hoctomap
