// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/LogWriter.h"

#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <limits>

#include "GzFileOutput.h"
#include "LogImages.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

struct LogWriter::Output {
  GzFileOutput file;
  double unit;
  std::unique_ptr<LogImages> images;  // none: images stand in the log
  std::optional<TruthPose> truth;     // the last one: scans of its time hang on it

  /// Pose of the sensor on the robot, so that truth (+) sensorPose is the sensor in the world.
  [[nodiscard]] Pose baseTSensor(double stamp, const Pose& world_T_sensor) const {
    return truth && truth->stamp == stamp ? -truth->world_T_base + world_T_sensor : world_T_sensor;
  }
  void add(const mrpt::serialization::CSerializable& object) {
    mrpt::serialization::archiveFrom(file).WriteObject(object);
  }
};

namespace {

void label(mrpt::obs::CObservation& observation, double stamp, const std::string& name) {
  observation.timestamp = mrpt::Clock::fromDouble(stamp);
  observation.sensorLabel = name;
}

mrpt::obs::CObservationRobotPose robotPose(double stamp, const std::string& name, const Pose& pose) {
  mrpt::obs::CObservationRobotPose observation;
  label(observation, stamp, name);
  observation.pose.mean = pose;
  observation.pose.cov.setZero();
  return observation;
}

std::uint16_t steps(float depth, double unit) {
  const double value = std::round(static_cast<double>(depth) / unit);
  const bool representable =
      value >= 1.0 && value <= std::numeric_limits<std::uint16_t>::max();  // false for NaN
  return representable ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
}

void setCamera(mrpt::obs::CObservation3DRangeScan& observation, const PinholeCamera& camera) {
  auto& parameters = observation.cameraParams;
  parameters.ncols = static_cast<std::uint32_t>(camera.width);
  parameters.nrows = static_cast<std::uint32_t>(camera.height);
  parameters.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
  observation.cameraParamsIntensity = parameters;
}

/// The picture is in register with the range image, perhaps of another size.
void setPicture(mrpt::obs::CObservation3DRangeScan& observation, const ColourImage& colour) {
  using mrpt::img::CImage;
  const auto columns = static_cast<unsigned>(colour.width);
  const auto rows = static_cast<unsigned>(colour.height);
  CImage image(columns, rows, mrpt::img::CH_RGB);
  const std::uint8_t* from = colour.rgb.data();
  for (unsigned v = 0; v < rows; ++v) {
    auto* to = image.ptrLine<std::uint8_t>(v);
    for (unsigned u = 0; u < columns; ++u, from += 3, to += 3) {  // MRPT's order is blue, green, red
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
    }
  }
  observation.hasIntensityImage = true;
  observation.intensityImage = std::move(image);
  // Both cameras in one place: MRPT's turn from x forward to z forward, and nothing else.
  observation.relativePoseIntensityWRTDepth = {0.0, 0.0, 0.0, -M_PI_2, 0.0, -M_PI_2};
  auto& parameters = observation.cameraParamsIntensity;
  parameters.scaleToResolution(columns, rows);
}

mrpt::maps::CPointsMap::Ptr pointsMap(const CloudScan& m) {
  if (m.colours.empty()) {
    const auto points = mrpt::maps::CSimplePointsMap::Create();
    points->reserve(m.sensor_points.size());
    for (const auto& p : m.sensor_points) points->insertPointFast(p.x(), p.y(), p.z());
    return points;
  }
  const auto points = mrpt::maps::CColouredPointsMap::Create();
  points->resize(m.sensor_points.size());
  const auto share = [](std::uint8_t value) { return static_cast<float>(value) / 255.0F; };
  for (std::size_t i = 0; i < m.sensor_points.size(); ++i) {
    const auto& p = m.sensor_points[i];
    const auto& c = m.colours[i];
    points->setPointRGB(i, p.x(), p.y(), p.z(), share(c[0]), share(c[1]), share(c[2]));
  }
  return points;
}

}  // namespace

struct LogWriter::Encoder {
  Output& out;

  void operator()(const TruthPose& m) const {
    out.truth = m;
    out.add(robotPose(m.stamp, m.label, m.world_T_base));
  }
  void operator()(const ObjectMotion& m) const {
    out.add(robotPose(m.stamp, "object_motion/" + std::to_string(m.node.value), m.motion));
  }
  void operator()(const DepthScan& m) const {
    mrpt::obs::CObservation3DRangeScan scan;
    label(scan, m.stamp, m.sensor);
    scan.sensorPose = out.baseTSensor(m.stamp, m.world_T_sensor);
    scan.hasRangeImage = true;
    scan.range_is_depth = true;
    scan.rangeUnits = static_cast<float>(out.unit);
    scan.maxRange = static_cast<float>(out.unit * std::numeric_limits<std::uint16_t>::max());
    setCamera(scan, m.image.camera);
    const auto width = static_cast<std::size_t>(m.image.camera.width);
    const auto height = static_cast<std::size_t>(m.image.camera.height);
    scan.rangeImage.setSize(height, width);
    for (std::size_t v = 0; v < height; ++v) {
      for (std::size_t u = 0; u < width; ++u)
        scan.rangeImage(v, u) = steps(m.image.depth[v * width + u], out.unit);
    }
    if (!m.colour.empty()) setPicture(scan, m.colour);
    if (out.images) out.images->moveOut(scan);
    out.add(scan);
  }
  void operator()(const CloudScan& m) const {
    mrpt::obs::CObservationPointCloud scan;
    label(scan, m.stamp, m.sensor);
    scan.sensorPose = out.baseTSensor(m.stamp, m.world_T_sensor);
    scan.pointcloud = pointsMap(m);
    out.add(scan);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

LogWriter::LogWriter(const std::filesystem::path& log, double depth_unit_m, bool external_images) {
  if (!std::isfinite(depth_unit_m) || depth_unit_m <= 0.0)
    throw ConfigError("the depth unit must be positive");
  auto images = external_images ? std::make_unique<LogImages>(log) : nullptr;
  output_.reset(new Output{GzFileOutput(log), depth_unit_m, std::move(images), std::nullopt});
}

LogWriter::~LogWriter() = default;

void LogWriter::write(const StreamMessage& message) {
  std::visit(Encoder{*output_}, message);
}

void LogWriter::finish() {
  LogImages* images = output_->images.get();
  if (images) images->commit();
  try {
    output_->file.commit();
  } catch (...) {
    if (images) images->withdraw();
    throw;
  }
}

}  // namespace hoctomap
