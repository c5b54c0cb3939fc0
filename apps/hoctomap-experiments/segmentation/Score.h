// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace hoctomap {

/// What a label image is worth beside the truth, from 0 to 1.
struct SegmentationScore {
  double precision = 0.0;  ///< share of the found objects' pixels that the true object holds, too
  double recall = 0.0;     ///< share of the true objects' pixels that the found object holds, too
  double f = 0.0;          ///< harmonic mean of the two
  double share75 = 0.0;    ///< share of the true objects that are found with F >= 0.75
  double found = 0.0;      ///< number of objects
  double objects = 0.0;    ///< number of true objects

  SegmentationScore& operator+=(const SegmentationScore& other);
};

/// A grey image, row-major.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

/// The truth of labelled scenes (0 no return, 1-9 table, 20-29 first object, 30-39 second, ...) with one
/// value an object: parts of an object that are less than 9 pixels apart are one, pieces that are cut
/// off by something in front are apart. 0 where there is no return, 1 where there is no object.
[[nodiscard]] GreyImage joinedTruth(const GreyImage& truth);

/// Overlap of found objects (values from 100) with the true ones (from 2 in `joined`), matched one to one so
/// that the sum of their F is largest. Pixels without a true return do not count.
[[nodiscard]] SegmentationScore scoreSegmentation(const GreyImage& found, const GreyImage& joined);

}  // namespace hoctomap
