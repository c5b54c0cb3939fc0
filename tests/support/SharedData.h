// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

namespace hoctomap::test {

/// The folder of real data: $HOCTOMAP_SHARED/data, else `../shared/data` beside the source tree. Tests that
/// need it skip with a reason when there is none.
std::optional<std::filesystem::path> sharedData();

/// Root of the source tree.
std::filesystem::path sourceDir();

}  // namespace hoctomap::test
