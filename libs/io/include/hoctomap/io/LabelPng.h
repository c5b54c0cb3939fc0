// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hoctomap {

/// Writes a grey image of 16 bits a pixel, row-major. @throws FileError
void writeLabelPng(const std::filesystem::path& path, int width, int height,
                   const std::vector<std::uint16_t>& values);

/// The same with 8 bits a pixel. @throws FileError
void writeGreyPng(const std::filesystem::path& path, int width, int height,
                  const std::vector<std::uint8_t>& values);

}  // namespace hoctomap
