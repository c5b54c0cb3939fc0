// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/RenderMap.h"

#include <mrpt/opengl/CFBORender.h>
#include <png.h>

#include <algorithm>
#include <cstdint>

#include "RenderCamera.h"
#include "SceneBuilder.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"

namespace hoctomap {
namespace {

constexpr unsigned kMaxSide = 8192;
constexpr unsigned kSamples = 2;  ///< rendered pixels per pixel and axis: smooth edges

void point(mrpt::opengl::CCamera& camera, const RenderCamera& view) {
  camera.setPointingAt(static_cast<float>(view.target.x()), static_cast<float>(view.target.y()),
                       static_cast<float>(view.target.z()));
  camera.setZoomDistance(static_cast<float>(view.distance));
  camera.setAzimuthDegrees(static_cast<float>(view.azimuth));
  camera.setElevationDegrees(static_cast<float>(view.elevation));
  camera.setProjectiveModel(true);
  camera.setProjectiveFOVdeg(static_cast<float>(view.field_of_view));
}

mrpt::img::CImage picture(const MapHierarchy& hierarchy, const RenderOptions& options) {
  mrpt::opengl::COpenGLScene scene;
  scene.insert(sceneOf(hierarchy, {true, options.labels, options.labels, options.hidden}));
  auto viewport = scene.getViewport();
  viewport->setCustomBackgroundColor({1.0F, 1.0F, 1.0F});
  const double aspect = static_cast<double>(options.width) / options.height;
  const RenderCamera view = options.sensor ? cameraOf(*options.sensor, hierarchy, aspect)
                                           : cameraFor(hierarchy, options.view, aspect, options.hidden);
  viewport->setViewportClipDistances(static_cast<float>(0.02 * view.distance),
                                     static_cast<float>(20.0 * view.distance));
  mrpt::opengl::CFBORender renderer(kSamples * options.width, kSamples * options.height);
  point(renderer.getCamera(scene), view);
  mrpt::img::CImage image;
  renderer.render_RGB(scene, image);
  return image;
}

/// Rows of RGB bytes, each the mean of the samples of one pixel.
std::vector<std::uint8_t> reduced(const mrpt::img::CImage& image, const RenderOptions& options) {
  std::vector<std::uint8_t> pixels(std::size_t{3} * options.width * options.height);
  std::vector<unsigned> sums(std::size_t{3} * options.width);
  for (unsigned row = 0; row < options.height; ++row) {
    std::fill(sums.begin(), sums.end(), 0U);
    for (unsigned i = 0; i < kSamples; ++i) {
      const auto* line = image.ptrLine<std::uint8_t>(kSamples * row + i);
      for (std::size_t sample = 0; sample < std::size_t{kSamples} * options.width; ++sample) {
        const std::size_t pixel = 3 * (sample / kSamples);
        for (std::size_t c = 0; c < 3; ++c) sums[pixel + c] += line[3 * sample + 2 - c];  // BGR
      }
    }
    std::uint8_t* out = &pixels[std::size_t{3} * options.width * row];
    for (std::size_t i = 0; i < sums.size(); ++i) {
      out[i] = static_cast<std::uint8_t>((sums[i] + kSamples) / (kSamples * kSamples));
    }
  }
  return pixels;
}

std::string pngBytes(const std::vector<std::uint8_t>& pixels, const RenderOptions& options) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = options.width;
  header.height = options.height;
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string bytes;
  bool ok = png_image_write_to_memory(&header, nullptr, &size, 0, pixels.data(), 0, nullptr) != 0;
  if (ok) {
    bytes.resize(size);
    ok = png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr) != 0;
  }
  if (!ok) throw FileError(std::string("cannot make the picture: ") + header.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

void renderMap(const MapHierarchy& hierarchy, const RenderOptions& options,
               const std::filesystem::path& file) {
  if (options.width == 0 || options.height == 0 || options.width > kMaxSide || options.height > kMaxSide) {
    throw ConfigError("a picture has 1 to " + std::to_string(kMaxSide) + " pixels a side");
  }
  std::vector<std::uint8_t> pixels;
  try {
    pixels = reduced(picture(hierarchy, options), options);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw FileError(std::string("cannot render (are libegl1 and libgl1-mesa-dri installed?): ") +
                    error.what());
  }
  replaceFile(file, pngBytes(pixels, options));
}

}  // namespace hoctomap
