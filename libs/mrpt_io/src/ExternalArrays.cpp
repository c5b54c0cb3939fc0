// SPDX-License-Identifier: BSD-3-Clause
#include "ExternalArrays.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ExternalBytes.h"
#include "ExternalFiles.h"
#include "ScanConverter.h"

namespace hoctomap {

namespace {

/// @return false if fewer than `count` are there. The memory grows with what is read, not with what is
/// promised.
template <class T>
bool readArray(ExternalBytes& bytes, std::uint64_t count, std::vector<T>& array) {
  constexpr std::size_t kStep = std::size_t{1} << 16;
  array.clear();
  while (array.size() < count) {
    checkPoints(array.size());
    const std::size_t begin = array.size();
    const std::size_t step = std::min<std::uint64_t>(kStep, count - begin);
    array.resize(begin + step);
    if (!bytes.read(array.data() + begin, step * sizeof(T))) return false;
  }
  return true;
}

bool readRangeImage(const ExternalFile& file, mrpt::math::CMatrix_u16& image) {
  ExternalBytes bytes(file);
  std::uint32_t size[2] = {};  // rows, columns
  std::vector<std::uint16_t> pixels;
  if (!bytes.read(size, sizeof size) || !readArray(bytes, std::uint64_t{size[0]} * size[1], pixels) ||
      !bytes.atEnd())
    return false;
  checkPoints(pixels.size());
  if (pixels.empty()) return true;
  image.setSize(size[0], size[1]);
  std::copy(pixels.begin(), pixels.end(), image.data());
  return true;
}

bool readPoints(const ExternalFile& file, mrpt::obs::CObservation3DRangeScan& scan) {
  ExternalBytes bytes(file);
  for (auto* coordinates : {&scan.points3D_x, &scan.points3D_y, &scan.points3D_z}) {
    std::uint32_t count = 0;
    std::vector<float> values;
    if (!bytes.read(&count, sizeof count) || !readArray(bytes, count, values)) return false;
    coordinates->assign(values.begin(), values.end());
  }
  return bytes.atEnd();
}

}  // namespace

bool readExternalArrays(mrpt::obs::CObservation3DRangeScan& scan, const std::filesystem::path& folder) {
  if (scan.hasRangeImage && scan.rangeImage_isExternallyStored() &&
      !readRangeImage(ExternalFile(folder, scan.rangeImage_getExternalStorageFile("")), scan.rangeImage))
    return false;
  return !scan.hasPoints3D || !scan.points3D_isExternallyStored() ||
         readPoints(ExternalFile(folder, scan.points3D_getExternalStorageFile()), scan);
}

}  // namespace hoctomap
