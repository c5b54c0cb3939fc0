// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hoctomap {

/// SHA-256 in hex over the bytes of the files, one after the other. Changed logs are recognised by it.
/// @throws InputError if one cannot be read.
[[nodiscard]] std::string sha256OfFiles(const std::vector<std::filesystem::path>& files);

}  // namespace hoctomap
