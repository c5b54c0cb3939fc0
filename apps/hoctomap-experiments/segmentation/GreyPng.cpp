// SPDX-License-Identifier: BSD-3-Clause
#include <png.h>

#include "LabelledScenes.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

GreyImage readGreyPng(const std::filesystem::path& file) {
  // libpng's simple interface turns 16 bits into linear light, but gives 8 bits of grey as they are.
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0)
    throw InputError(file.string() + ": " + png.message);
  if ((png.format & (PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_LINEAR | PNG_FORMAT_FLAG_COLORMAP)) != 0U) {
    png_image_free(&png);
    throw InputError(file.string() + ": not a grey image of 8 bits");
  }
  png.format = PNG_FORMAT_GRAY;
  std::vector<std::uint8_t> values(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, values.data(), 0, nullptr) == 0) {
    throw InputError(file.string() + ": " + png.message);
  }
  return {static_cast<int>(png.width), static_cast<int>(png.height), {values.begin(), values.end()}};
}

}  // namespace hoctomap
