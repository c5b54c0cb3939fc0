// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <filesystem>

namespace hoctomap {

/// Fills range image and points of a scan from the binary files that MRPT keeps them in beside a log (.bin:
/// plain or gzip; rows, columns and pixels, or three arrays with their lengths). MRPT's own loader takes the
/// counts as they are: it crashes on some, and takes what is missing from a file that was cut for zeros.
/// @param scan all its external files are such ones, and exist
/// @return false if one of them is not whole
/// @throws LimitError if one holds more than 10^7 points
[[nodiscard]] bool readExternalArrays(mrpt::obs::CObservation3DRangeScan& scan,
                                      const std::filesystem::path& folder);

}  // namespace hoctomap
