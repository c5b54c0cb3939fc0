// SPDX-License-Identifier: BSD-3-Clause
#include "ScanConverter.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <mrpt/system/filesystem.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ExternalArrays.h"
#include "ExternalCloud.h"
#include "ExternalFiles.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

namespace {

constexpr const char* kMissing = "missing external file";
constexpr const char* kDamaged = "damaged external file";

template <class X, class Y, class Z>
SensorScan cloudFrom(const X& x, const Y& y, const Z& z) {
  if (x.size() != y.size() || x.size() != z.size()) return Unusable{"x, y and z of different length"};
  checkPoints(x.size());
  PointCloud points(x.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {x[i], y[i], z[i]};
  return points;
}

std::optional<PinholeCamera> cameraOf(const CObservation3DRangeScan& scan) {
  const auto& p = scan.cameraParams;
  const PinholeCamera camera{static_cast<int>(scan.rangeImage.cols()),
                             static_cast<int>(scan.rangeImage.rows()),
                             p.fx(),
                             p.fy(),
                             p.cx(),
                             p.cy()};
  const bool finite = std::isfinite(camera.fx) && std::isfinite(camera.fy) && std::isfinite(camera.cx) &&
                      std::isfinite(camera.cy);
  if (!finite || camera.fx <= 0.0 || camera.fy <= 0.0) return std::nullopt;
  return camera;
}

/// Range along the ray -> depth along the optical axis, for every pixel.
void rangeToDepth(DepthImage& image) {
  for (int v = 0; v < image.camera.height; ++v) {
    float* row = image.depth.data() + static_cast<std::ptrdiff_t>(v) * image.camera.width;
    for (int u = 0; u < image.camera.width; ++u)
      row[u] = static_cast<float>(static_cast<double>(row[u]) / image.camera.point(u, v, 1.0).norm());
  }
}

SensorScan depthFrom(const CObservation3DRangeScan& scan) {
  const auto rows = static_cast<std::size_t>(scan.rangeImage.rows());
  const auto columns = static_cast<std::size_t>(scan.rangeImage.cols());
  checkPoints(rows * columns);
  const auto camera = cameraOf(scan);
  if (!camera) return Unusable{"camera parameters are zero or not finite"};
  const double units = static_cast<double>(scan.rangeUnits);
  if (!std::isfinite(units) || units <= 0.0) return Unusable{"range units are not positive"};

  DepthImage image{*camera, {}};
  image.depth.reserve(rows * columns);
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t u = 0; u < columns; ++u)
      image.depth.push_back(static_cast<float>(units * scan.rangeImage(v, u)));
  }
  if (!scan.range_is_depth) rangeToDepth(image);
  return image;
}

bool isText(const std::string& name) {
  constexpr bool kIgnoreGz = true;  // as MRPT tells them
  return mrpt::system::strCmpI(mrpt::system::extractFileExtension(name, kIgnoreGz), "txt");
}

/// Loads what the scan stores outside. @return whether it is whole
bool load(CObservation3DRangeScan& scan, const std::vector<std::string>& names,
          const std::filesystem::path& folder) {
  return std::any_of(names.begin(), names.end(), isText) ? loadExternals(scan, folder)
                                                         : readExternalArrays(scan, folder);
}

bool allExist(const std::vector<std::string>& names, const std::filesystem::path& folder) {
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return ExternalFile(folder, name).exists(); });
}

SensorScan convert(CObservation3DRangeScan& scan, const std::filesystem::path& folder) {
  const std::vector<std::string> names = externalNames(scan);
  if (!allExist(names, folder)) return Unusable{kMissing};
  if (!load(scan, names, folder)) return Unusable{kDamaged};
  if (scan.hasRangeImage && scan.rangeImage.size() > 0) return depthFrom(scan);
  if (scan.hasPoints3D) return cloudFrom(scan.points3D_x, scan.points3D_y, scan.points3D_z);
  return Unusable{"neither a range image nor points"};
}

SensorScan convert(const CObservationPointCloud& scan, const std::filesystem::path& folder) {
  if (!allExist(externalNames(scan), folder)) return Unusable{kMissing};
  if (scan.isExternallyStored()) {
    auto points = readExternalCloud(scan, folder);
    if (!points) return Unusable{kDamaged};
    return *std::move(points);
  }
  if (!scan.pointcloud) return Unusable{"neither a range image nor points"};
  const auto& map = *scan.pointcloud;
  return cloudFrom(map.getPointsBufferRef_x(), map.getPointsBufferRef_y(), map.getPointsBufferRef_z());
}

SensorScan convert(CObservationVelodyneScan& scan) {
  try {
    if (scan.point_cloud.x.empty()) scan.generatePointCloud();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return Unusable{"packets that cannot be decoded"};
  }
  return cloudFrom(scan.point_cloud.x, scan.point_cloud.y, scan.point_cloud.z);
}

SensorScan convert(const CObservation2DRangeScan& scan) {
  checkPoints(scan.getScanSize());
  PointCloud points;
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    const float range = scan.getScanRange(i);
    // Devices report "nothing in range" as a range at or beyond the maximum.
    if (!scan.getScanRangeValidity(i) || !(range < scan.maxRange)) continue;
    const float angle = scan.getScanAngle(i);
    points.emplace_back(range * std::cos(angle), range * std::sin(angle), 0.0F);
  }
  return points;
}

/// The class does not store the elevation of its rows: with a single row it is zero.
SensorScan convert(const CObservationRotatingScan& scan) {
  const auto columns = static_cast<std::size_t>(scan.rangeImage.cols());
  if (scan.rangeImage.rows() != 1 || columns < 2) return Unusable{"a rotating scan without elevations"};
  checkPoints(columns);
  if (!std::isfinite(scan.rangeResolution) || scan.rangeResolution <= 0.0)
    return Unusable{"range units are not positive"};
  PointCloud points;
  for (std::size_t i = 0; i < columns; ++i) {
    const double range = scan.rangeResolution * scan.rangeImage(0, i);
    if (range <= 0.0) continue;
    const double azimuth =
        scan.startAzimuth + scan.azimuthSpan * static_cast<double>(i) / static_cast<double>(columns - 1);
    points.emplace_back((Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0) * range).cast<float>());
  }
  return points;
}

}  // namespace

void checkPoints(std::size_t count) {
  constexpr std::size_t kMaxPoints = 10'000'000;
  if (count > kMaxPoints) throw LimitError("a scan of more than " + std::to_string(kMaxPoints) + " points");
}

bool isScan(const mrpt::obs::CObservation& observation) {
  if (const auto* rotating = dynamic_cast<const CObservationRotatingScan*>(&observation))
    return rotating->rangeImage.rows() == 1;
  return dynamic_cast<const CObservation3DRangeScan*>(&observation) != nullptr ||
         dynamic_cast<const CObservationPointCloud*>(&observation) != nullptr ||
         dynamic_cast<const CObservationVelodyneScan*>(&observation) != nullptr ||
         dynamic_cast<const CObservation2DRangeScan*>(&observation) != nullptr;
}

std::vector<std::string> externalNames(const mrpt::obs::CObservation& observation) {
  std::vector<std::string> names;
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
    if (scan->hasRangeImage && scan->rangeImage_isExternallyStored()) {
      names.push_back(scan->rangeImage_getExternalStorageFile(""));
      for (const auto& [layer, unused] : scan->rangeImageOtherLayers)  // loaded along with the first one
        names.push_back(scan->rangeImage_getExternalStorageFile(layer));
    }
    if (scan->hasPoints3D && scan->points3D_isExternallyStored())
      names.push_back(scan->points3D_getExternalStorageFile());
  } else if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation)) {
    if (cloud->isExternallyStored()) names.push_back(cloud->getExternalStorageFile());
  }
  return names;
}

std::pair<std::uint32_t, std::uint32_t> imageSize(const mrpt::obs::CObservation& observation) {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
  if (scan == nullptr || !scan->hasRangeImage) return {0, 0};
  return {static_cast<std::uint32_t>(scan->rangeImage.cols()),
          static_cast<std::uint32_t>(scan->rangeImage.rows())};
}

SensorScan convertScan(mrpt::obs::CObservation& observation, const std::filesystem::path& images_folder) {
  if (auto* depth = dynamic_cast<CObservation3DRangeScan*>(&observation))
    return convert(*depth, images_folder);
  if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation))
    return convert(*cloud, images_folder);
  if (auto* velodyne = dynamic_cast<CObservationVelodyneScan*>(&observation)) return convert(*velodyne);
  if (auto* laser = dynamic_cast<CObservation2DRangeScan*>(&observation)) return convert(*laser);
  if (auto* rotating = dynamic_cast<CObservationRotatingScan*>(&observation)) return convert(*rotating);
  throw std::logic_error("convertScan: not a scan");
}

std::string remarkOn(const mrpt::obs::CObservation& observation) {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
  if (scan == nullptr || !scan->hasRangeImage || scan->rangeImage.size() == 0) return {};
  const auto& camera = scan->cameraParams;
  for (const double coefficient : camera.dist) {
    if (coefficient != 0.0) return "lens distortion is ignored: the images are taken as rectified";
  }
  return {};
}

}  // namespace hoctomap
