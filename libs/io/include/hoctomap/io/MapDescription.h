// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// The tree of a map as text, one line a node: what `hoctomap info DIR` prints. Ends with a newline.
[[nodiscard]] std::string describeMap(const Manifest& manifest);

/// The same as JSON (an object; keys as in `hierarchy.yaml`). Ends with a newline.
[[nodiscard]] std::string mapJson(const Manifest& manifest);

}  // namespace hoctomap
