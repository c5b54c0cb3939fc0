// SPDX-License-Identifier: BSD-3-Clause
#include "PngImage.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMaxPixels = 10'000'000;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string nameOf(const std::filesystem::path& file) {
  return escapedText(file.string());
}

File openPng(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(nameOf(path) + ": no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError(nameOf(path) + ": not a regular file");
  File file(std::fopen(path.c_str(), "rbe"), &std::fclose);
  if (!file) throw InputError(nameOf(path) + ": cannot be opened");
  return file;
}

void checkPixels(const std::filesystem::path& path, std::size_t width, std::size_t height) {
  if (width > kMaxPixels / height)
    throw LimitError(nameOf(path) + ": more than " + std::to_string(kMaxPixels) + " pixels");
}

// libpng reports errors by a jump: what a reader has to free and to tell lies here, outside of the function
// that is left by it.
struct Decoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::array<char, 200> message{};

  Decoder() {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
  }
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  static void onError(png_structp png, png_const_charp text) {
    auto& message = static_cast<Decoder*>(png_get_error_ptr(png))->message;
    std::strncpy(message.data(), text, message.size() - 1);
    png_longjmp(png, 1);
  }
};

bool readHeader(Decoder& decoder, std::FILE* file) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_init_io(decoder.png, file);
  png_read_info(decoder.png, decoder.info);
  return true;
}

bool readRows(Decoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_swap(decoder.png);  // PNG stores the high byte first
  png_read_image(decoder.png, rows);
  png_read_end(decoder.png, nullptr);
  return true;
}

/// What kind of image it is, if it is not 16-bit grey.
std::string kindOf(const Decoder& decoder) {
  const int channels = png_get_channels(decoder.png, decoder.info);
  return std::to_string(channels) + (channels == 1 ? " channel of " : " channels of ") +
         std::to_string(png_get_bit_depth(decoder.png, decoder.info)) + " bits";
}

}  // namespace

RawDepth readDepthPng(const std::filesystem::path& path) {
  const File file = openPng(path);
  Decoder decoder;
  if (!readHeader(decoder, file.get()))
    throw InputError(nameOf(path) + ": not a PNG image: " + decoder.message.data());
  if (png_get_color_type(decoder.png, decoder.info) != PNG_COLOR_TYPE_GRAY ||
      png_get_bit_depth(decoder.png, decoder.info) != 16) {
    throw InputError(nameOf(path) + ": a depth image is grey with 16 bits a pixel, this one has " +
                     kindOf(decoder));
  }
  const std::size_t width = png_get_image_width(decoder.png, decoder.info);
  const std::size_t height = png_get_image_height(decoder.png, decoder.info);
  checkPixels(path, width, height);
  RawDepth image{static_cast<int>(width), static_cast<int>(height),
                 std::vector<std::uint16_t>(width * height)};
  std::vector<png_bytep> rows(height);
  for (std::size_t v = 0; v < height; ++v)
    rows[v] = reinterpret_cast<png_bytep>(image.steps.data() + v * width);
  if (!readRows(decoder, rows.data()))
    throw InputError(nameOf(path) + ": damaged image: " + decoder.message.data());
  return image;
}

void SequenceSize::require(const RawDepth& image) {
  if (width == 0) {
    width = image.width;
    height = image.height;
  }
  if (image.width != width || image.height != height)
    throw InputError("an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                     " pixels instead of " + std::to_string(width) + " x " + std::to_string(height));
}

ColourImage readColourPng(const std::filesystem::path& path) {
  const File file = openPng(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto check = [&](int ok) {
    if (ok != 0) return;
    const std::string why = image.message;
    png_image_free(&image);
    throw InputError(nameOf(path) + ": not a whole PNG image: " + why);
  };
  check(png_image_begin_read_from_stdio(&image, file.get()));
  try {
    checkPixels(path, image.width, image.height);
  } catch (...) {
    png_image_free(&image);
    throw;
  }
  image.format = PNG_FORMAT_RGB;
  ColourImage colour{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  colour.rgb.resize(PNG_IMAGE_SIZE(image));
  const png_color black{};  // under what is transparent
  check(png_image_finish_read(&image, &black, colour.rgb.data(), 0, nullptr));
  return colour;
}

}  // namespace hoctomap
