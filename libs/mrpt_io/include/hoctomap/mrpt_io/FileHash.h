// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace hoctomap {

/// SHA-256 in hex over the bytes of a file. Changed logs are recognised by it.
/// @throws InputError if it cannot be read.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace hoctomap
