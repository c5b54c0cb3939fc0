// SPDX-License-Identifier: BSD-3-Clause
#include "LogImages.h"

#include <unistd.h>
#include <zlib.h>

#include <array>
#include <memory>
#include <system_error>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

[[noreturn]] void cannotWrite(const std::filesystem::path& file) {
  throw FileError(escapedText(file.string()) + ": cannot be written");
}

/// MRPT does not say whether it could write a range image: whether all of it can be read.
void requireWhole(const std::filesystem::path& file, std::size_t bytes) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), &gzclose);
  if (!in) cannotWrite(file);
  std::array<char, 1 << 16> buffer{};
  std::size_t got = 0;
  for (int n = 0; (n = gzread(in.get(), buffer.data(), buffer.size())) != 0;) {
    if (n < 0) cannotWrite(file);
    got += static_cast<std::size_t>(n);
  }
  if (got < bytes) cannotWrite(file);
}

}  // namespace

LogImages::LogImages(const std::filesystem::path& log)
    : folder_(log.parent_path() / (log.stem().string() + "_Images")),
      temporary_(log.parent_path() /
                 ("." + log.stem().string() + "_Images." + std::to_string(::getpid()) + ".tmp")) {
  std::error_code error;
  if (std::filesystem::exists(folder_, error))
    throw ConfigError(escapedText(folder_.string()) +
                      ": exists; remove it or choose another name for the log");
  if (!std::filesystem::create_directory(temporary_, error))
    throw FileError(escapedText(temporary_.string()) + ": cannot make the folder");
}

LogImages::~LogImages() {
  std::error_code ignored;
  std::filesystem::remove_all(temporary_, ignored);
}

void LogImages::moveOut(mrpt::obs::CObservation3DRangeScan& scan) {
  const std::string number = std::to_string(scans_++);
  const std::string name = std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number;
  if (scan.hasIntensityImage) {
    const std::string file = name + "_colour.png";
    if (!scan.intensityImage.saveToFile((temporary_ / file).string())) cannotWrite(temporary_ / file);
    scan.intensityImage.setExternalStorage(file);
  }
  const std::size_t bytes = static_cast<std::size_t>(scan.rangeImage.size()) * sizeof(std::uint16_t);
  scan.rangeImage_convertToExternalStorage(name + "_range.bin", temporary_.string() + "/");
  requireWhole(temporary_ / (name + "_range.bin"), bytes);
}

void LogImages::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, folder_, error);
  if (error) throw FileError(escapedText(folder_.string()) + ": cannot be renamed: " + error.message());
}

void LogImages::withdraw() {
  std::error_code ignored;
  std::filesystem::rename(folder_, temporary_, ignored);
}

}  // namespace hoctomap
