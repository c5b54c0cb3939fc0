// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// Whether a path of a manifest stays inside the map directory, and can be printed.
[[nodiscard]] bool staysInside(const std::string& path);

/// 64 lower-case hexadecimal digits.
[[nodiscard]] bool isSha256(const std::string& text);

/// What is wrong with the values of a record by themselves (Manifest.h); null if nothing is. Its numbers are
/// finite and its poses rigid.
[[nodiscard]] const char* problemOf(const NodeRecord& node);

}  // namespace hoctomap
