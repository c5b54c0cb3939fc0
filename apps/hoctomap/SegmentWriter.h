// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "hoctomap/mapping/LabelingFunction.h"

namespace hoctomap {

/// Writes the results of `segment` into a directory:
/// - `labels/KKKKKK.png` for scan K with an image, 16 bit (hoctomap/tabletop/LabelImage.h says the values);
/// - `labels/KKKKKK.csv` for an unorganised cloud: one value a line, in the order of the points used;
/// - `segments.csv`: centre and half extents of the box of each segment along the world's axes, metres.
class SegmentWriter {
 public:
  /// @throws ConfigError if the directory holds something and `overwrite` is not set; FileError
  SegmentWriter(const std::filesystem::path& directory, bool overwrite);

  void write(const Measurement& z, std::span<const Segment> segments, const LabelingFunction& labeling);
  void finish();

 private:
  std::filesystem::path directory_;
  std::string rows_;
};

}  // namespace hoctomap
