// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// The points of a `.pcd`, `.ply` (Open3D) or `.bin` file (KITTI: x y z reflectance as floats), in the order
/// of the file, with colours if it has them.
/// @throws InputError naming the file if it is no whole cloud; LimitError beyond 10^7 points
[[nodiscard]] CloudScan readCloudFile(const std::filesystem::path& file);

}  // namespace hoctomap
