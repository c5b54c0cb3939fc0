// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace hoctomap {

/// Puts a file of these bytes in place of `file`, all or nothing: written beside it, checked, synced,
/// renamed.
/// @throws FileError
void replaceFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace hoctomap
