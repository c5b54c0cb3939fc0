// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

struct RawDepth {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> steps;  ///< row-major
};

/// Reads a grey PNG of 16 bits a pixel, as it is.
/// @throws InputError if it is missing, no PNG, damaged, or of another kind; LimitError beyond 10^7 pixels
[[nodiscard]] RawDepth readDepthPng(const std::filesystem::path& file);

/// The size of all images of a sequence: what is known of it, else that of the first one asked about.
struct SequenceSize {
  int width = 0;
  int height = 0;

  /// @throws InputError if the image is of another size
  void require(const RawDepth& image);
};

/// Reads any PNG as 8-bit red, green, blue. @throws InputError, LimitError as above
[[nodiscard]] ColourImage readColourPng(const std::filesystem::path& file);

}  // namespace hoctomap
