// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/LabelPng.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

void ignoreWarning(png_structp, png_const_charp) {}

// libpng reports errors by a jump back into this function: it must hold no object with a destructor.
template <class Value>
bool encode(std::FILE* file, png_uint_32 width, png_uint_32 height, const Value* values) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, ignoreWarning);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, 8 * sizeof(Value), PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if constexpr (sizeof(Value) == 2) png_set_swap(png);  // PNG stores the high byte first
  for (png_uint_32 row = 0; row < height; ++row)
    png_write_row(png, reinterpret_cast<png_const_bytep>(values + static_cast<std::size_t>(row) * width));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

template <class Value>
void writePng(const std::filesystem::path& path, int width, int height, const std::vector<Value>& values) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool encoded = file != nullptr && encode(file, static_cast<png_uint_32>(width),
                                                 static_cast<png_uint_32>(height), values.data());
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (!encoded || !closed) throw FileError(path.string() + ": cannot write");
}

}  // namespace

void writeLabelPng(const std::filesystem::path& path, int width, int height,
                   const std::vector<std::uint16_t>& values) {
  writePng(path, width, height, values);
}

void writeGreyPng(const std::filesystem::path& path, int width, int height,
                  const std::vector<std::uint8_t>& values) {
  writePng(path, width, height, values);
}

}  // namespace hoctomap
