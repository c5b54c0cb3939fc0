// SPDX-License-Identifier: BSD-3-Clause
#include "CloudFile.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/io/PointCloudIO.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

constexpr std::size_t kMaxPoints = 10'000'000;

void checkPoints(const std::string& name, std::size_t points) {
  if (points > kMaxPoints) throw LimitError(name + ": more than " + std::to_string(kMaxPoints) + " points");
}

std::uint8_t byteOf(double share) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

/// What the header of a PCD announces. Open3D takes memory by it before it reads a point, takes a text that
/// ends early for whole, and an encoding that it does not know for text.
struct PcdHeader {
  std::size_t points = 0;
  std::string encoding;
  bool ascii = false;
  std::size_t lines = 0;  ///< of points, if ascii
};

PcdHeader pcdHeader(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  PcdHeader header;
  std::string line;
  while (std::getline(in, line)) {
    const auto value = line.substr(std::min(line.size(), line.find(' ') + 1));
    if (line.starts_with("POINTS "))
      std::from_chars(value.data(), value.data() + value.size(), header.points);
    if (!line.starts_with("DATA ")) continue;
    header.encoding = value.substr(0, value.find_last_not_of(" \r") + 1);
    header.ascii = header.encoding == "ascii";
    break;
  }
  while (header.ascii && std::getline(in, line))
    header.lines += line.find_first_not_of(" \t\r") != std::string::npos ? 1U : 0U;
  return header;
}

void checkPcd(const std::filesystem::path& file, const std::string& name) {
  const PcdHeader header = pcdHeader(file);
  checkPoints(name, header.points);
  if (!header.ascii && header.encoding != "binary" && header.encoding != "binary_compressed")
    throw InputError(name + ": no whole point cloud, or of an unknown encoding");
  if (header.ascii && header.lines != header.points)
    throw InputError(name + ": " + std::to_string(header.lines) + " lines of points instead of " +
                     std::to_string(header.points));
}

CloudScan readWithOpen3d(const std::filesystem::path& file, const std::string& name) {
  if (file.extension() == ".pcd") checkPcd(file, name);
  open3d::geometry::PointCloud cloud;
  open3d::io::ReadPointCloudOption options;
  options.remove_nan_points = false;
  options.remove_infinite_points = false;
  bool whole = false;
  try {
    whole = open3d::io::ReadPointCloud(file.string(), cloud, options);
  } catch (const std::bad_alloc&) {
    throw LimitError(name + ": too large for the memory that a reader gets");
  } catch (const std::exception&) {
    // told below
  }
  if (!whole) throw InputError(name + ": no whole point cloud, or of an unknown encoding");
  checkPoints(name, cloud.points_.size());
  CloudScan scan;
  scan.sensor_points.reserve(cloud.points_.size());
  for (const Eigen::Vector3d& p : cloud.points_) scan.sensor_points.push_back(p.cast<float>());
  if (cloud.colors_.size() == cloud.points_.size()) {
    for (const Eigen::Vector3d& c : cloud.colors_)
      scan.colours.push_back({byteOf(c.x()), byteOf(c.y()), byteOf(c.z())});
  }
  return scan;
}

CloudScan readKitti(const std::filesystem::path& file, const std::string& name) {
  constexpr std::size_t kFloats = 4;
  const std::size_t bytes = std::filesystem::file_size(file);
  if (bytes % (kFloats * sizeof(float)) != 0)
    throw InputError(name + ": " + std::to_string(bytes) +
                     " bytes are no whole number of points of 16 bytes");
  const std::size_t points = bytes / (kFloats * sizeof(float));
  checkPoints(name, points);
  std::vector<float> values(kFloats * points);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes));
  if (!in) throw InputError(name + ": cannot be read");
  CloudScan scan;
  for (std::size_t i = 0; i < points; ++i)
    scan.sensor_points.emplace_back(Eigen::Map<const Eigen::Vector3f>(&values[kFloats * i]));
  return scan;
}

}  // namespace

CloudScan readCloudFile(const std::filesystem::path& file) {
  const std::string name = escapedText(file.string());
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(name + ": no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(name + ": not a regular file");
  return file.extension() == ".bin" ? readKitti(file, name) : readWithOpen3d(file, name);
}

}  // namespace hoctomap
