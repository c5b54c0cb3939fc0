// SPDX-License-Identifier: BSD-3-Clause
#include "log_objects.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <stdlib.h>
#include <zlib.h>

#include <fstream>
#include <stdexcept>

#include "hoctomap/mrpt_io/LogReader.h"

namespace hoctomap::test {

namespace {

std::string bytesOf(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream).WriteObject(object);
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

template <class Observation>
void label(Observation& observation, double stamp, const std::string& name) {
  observation.timestamp = mrpt::Clock::fromDouble(stamp);
  observation.sensorLabel = name;
}

mrpt::obs::CObservation3DRangeScan::Ptr depthScan(const DepthSpec& spec) {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  label(*scan, spec.stamp, spec.label);
  scan->sensorPose = spec.base_T_sensor;
  scan->hasRangeImage = true;
  scan->range_is_depth = spec.is_depth;
  scan->rangeUnits = spec.units;
  scan->cameraParams.ncols = static_cast<std::uint32_t>(spec.width);
  scan->cameraParams.nrows = static_cast<std::uint32_t>(spec.height);
  scan->cameraParams.setIntrinsicParamsFromValues(spec.fx, spec.fx, 3.5, 2.5);
  scan->rangeImage.setSize(static_cast<std::size_t>(spec.height), static_cast<std::size_t>(spec.width));
  scan->rangeImage.fill(spec.value);
  return scan;
}

mrpt::obs::CObservationRobotPose::Ptr robotPose(double stamp, const std::string& name, const Pose& pose) {
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  label(*observation, stamp, name);
  observation->pose.mean = pose;
  return observation;
}

mrpt::maps::CSimplePointsMap::Ptr mapOf(const PointCloud& points) {
  auto map = mrpt::maps::CSimplePointsMap::Create();
  for (const auto& p : points) map->insertPointFast(p.x(), p.y(), p.z());
  return map;
}

}  // namespace

std::string poseObject(double stamp, const std::string& name, const Pose& pose) {
  return bytesOf(*robotPose(stamp, name, pose));
}

std::string depthObject(const DepthSpec& spec) {
  const auto scan = depthScan(spec);
  if (spec.external.empty()) return bytesOf(*scan);
  // MRPT writes the external file itself; then another name of the same length takes the place of its name.
  const Folder scratch;
  const std::string placeholder(spec.external.size(), 'x');
  scan->rangeImage_convertToExternalStorage(placeholder, scratch.path.string() + "/");
  std::string bytes = bytesOf(*scan);
  const std::string stored = scan->rangeImage_getExternalStorageFile("");
  const auto at = bytes.find(stored);
  if (at == std::string::npos || spec.external.size() > stored.size())
    throw std::logic_error("no external name");
  bytes.replace(
      at - 4, 4 + stored.size(),
      std::string(1, static_cast<char>(spec.external.size())) + std::string(3, '\0') + spec.external);
  return bytes;
}

std::string externalPointsObject(const PointCloud& points, const std::filesystem::path& images,
                                 const std::string& name) {
  mrpt::obs::CObservation3DRangeScan scan;
  label(scan, 100.0, "RGBD");
  scan.hasPoints3D = true;
  scan.resizePoints3DVectors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    scan.points3D_x[i] = points[i].x();
    scan.points3D_y[i] = points[i].y();
    scan.points3D_z[i] = points[i].z();
  }
  scan.points3D_convertToExternalStorage(name + ".bin", images.string() + "/");
  return bytesOf(scan);
}

std::string cloudObject(double stamp, const std::string& name, const PointCloud& points) {
  mrpt::obs::CObservationPointCloud scan;
  label(scan, stamp, name);
  scan.pointcloud = mapOf(points);
  return bytesOf(scan);
}

std::string externalCloudObject(CloudFormat format, const std::string& file) {
  mrpt::obs::CObservationPointCloud scan;
  label(scan, 100.0, "LIDAR");
  using Format = mrpt::obs::CObservationPointCloud::ExternalStorageFormat;
  scan.setAsExternalStorage(file, static_cast<Format>(format));
  return bytesOf(scan);
}

std::string mapObject(const PointCloud& points) {
  return bytesOf(*mapOf(points));
}

std::string laserObject(double stamp, const std::vector<float>& ranges, float max_range) {
  mrpt::obs::CObservation2DRangeScan scan;
  label(scan, stamp, "LASER");
  scan.maxRange = max_range;
  scan.aperture = static_cast<float>(M_PI);
  scan.rightToLeft = true;
  scan.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.setScanRange(i, ranges[i]);
    scan.setScanRangeValidity(i, true);
  }
  return bytesOf(scan);
}

std::string odometryObject(double stamp, double x) {
  mrpt::obs::CObservationOdometry odometry;
  label(odometry, stamp, "ODOMETRY");
  odometry.odometry = mrpt::poses::CPose2D(x, 0.0, 0.0);
  return bytesOf(odometry);
}

std::string imuObject(double stamp) {
  mrpt::obs::CObservationIMU imu;
  label(imu, stamp, "IMU");
  return bytesOf(imu);
}

std::string actionAndFrame(double stamp, double x, std::uint32_t particles) {
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  if (particles > 0) {
    model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
    model.thrunModel.nParticlesCount = particles;
  }
  movement.computeFromOdometry(mrpt::poses::CPose2D(x, 0.0, 0.0), model);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  DepthSpec spec;
  spec.stamp = stamp;
  return bytesOf(actions) + frameObject({spec});
}

std::string frameObject(const std::vector<DepthSpec>& scans) {
  mrpt::obs::CSensoryFrame frame;
  for (const auto& scan : scans) frame.insert(depthScan(scan));
  return bytesOf(frame);
}

std::string rawlogObject(const std::vector<DepthSpec>& scans) {
  mrpt::obs::CRawlog log;
  double x = 0.0;
  for (const auto& scan : scans) {
    log.insert(mrpt::obs::CObservation::Ptr(robotPose(scan.stamp, "groundtruth", Pose(x, 0, 0, 0, 0, 0))));
    log.insert(mrpt::obs::CObservation::Ptr(depthScan(scan)));
    x += 1.0;
  }
  return bytesOf(log);
}

std::string simpleMapObject(const DepthSpec& scan, const Pose& map_T_base) {
  mrpt::maps::CSimpleMap map;
  auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
  pose->mean = map_T_base;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(depthScan(scan));
  map.insert(mrpt::poses::CPose3DPDF::Ptr(pose), frame);
  return bytesOf(map);
}

std::string gz(const std::string& bytes) {
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, bytes.size()) + 64, '\0');
  std::string in = bytes;
  z.next_in = reinterpret_cast<Bytef*>(in.data());
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

std::string sweep(int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    DepthSpec spec;
    spec.stamp = 100.0 + i;
    spec.value = static_cast<std::uint16_t>(1000 + i);
    bytes += poseObject(spec.stamp, "groundtruth", Pose(i, 0, 0, 0, 0, 0)) + depthObject(spec);
  }
  return bytes;
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "hoctomap_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

std::filesystem::path Folder::write(const std::string& name, const std::string& bytes) const {
  const auto file = path / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

LogReadOptions optionsFor(const std::filesystem::path& log) {
  LogReadOptions options;
  options.logs = {log};
  return options;
}

std::vector<StreamMessage> readLog(const LogReadOptions& options) {
  std::vector<StreamMessage> messages;
  ReadProgress progress;
  LogReader reader(options, progress);
  reader.stream([&](const StreamMessage& message, const StreamPosition&) { messages.push_back(message); });
  return messages;
}

}  // namespace hoctomap::test
