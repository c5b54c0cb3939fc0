// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/geometry/Pose.h"
#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/io/ScanStream.h"

// Logs for tests, put together from single objects as MRPT serialises them.
namespace hoctomap::test {

struct DepthSpec {
  double stamp = 0.0;
  std::string label = "RGBD";
  Pose base_T_sensor;
  int width = 8;
  int height = 6;
  double fx = 10.0;
  float units = 0.001F;
  bool is_depth = true;
  std::string external;        ///< name of an external range image
  std::uint16_t value = 1000;  ///< of every pixel
};

std::string poseObject(double stamp, const std::string& label, const Pose& pose);
std::string depthObject(const DepthSpec& spec);
/// A depth camera's points, without an image; MRPT writes them to `images`/NAME.bin.
std::string externalPointsObject(const PointCloud& points, const std::filesystem::path& images,
                                 const std::string& name);
std::string cloudObject(double stamp, const std::string& label, const PointCloud& points);
/// A cloud whose points stand in a file beside the log.
enum class CloudFormat : std::uint8_t { map_object = 1, records = 2, text = 3 };
std::string externalCloudObject(CloudFormat format, const std::string& file);
/// MRPT's map of these points.
std::string mapObject(const PointCloud& points);
std::string laserObject(double stamp, const std::vector<float>& ranges, float max_range);
std::string odometryObject(double stamp, double x);
std::string imuObject(double stamp);
/// Action with odometry increment x, then a sensory frame of one depth scan. @param particles that the action
/// has drawn of its motion model; 0: its model is a Gaussian
std::string actionAndFrame(double stamp, double x, std::uint32_t particles = 0);
std::string frameObject(const std::vector<DepthSpec>& scans);
/// One CRawlog that holds these scans, each with a pose `groundtruth` of its number in x.
std::string rawlogObject(const std::vector<DepthSpec>& scans);
std::string simpleMapObject(const DepthSpec& scan, const Pose& map_T_base);
inline std::string nullObject() {
  return "\x87nullptr\x88";
}

std::string gz(const std::string& bytes);

/// A plain log of `count` scans, one a second, each after its pose (x = number).
std::string sweep(int count);

/// A folder for one test, removed behind it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& bytes) const;
  std::filesystem::path path;
};

LogReadOptions optionsFor(const std::filesystem::path& log);

/// All messages of a log, read in this process.
std::vector<StreamMessage> readLog(const LogReadOptions& options);

template <class T>
std::vector<T> only(const std::vector<StreamMessage>& messages) {
  std::vector<T> found;
  for (const auto& message : messages) {
    if (const auto* one = std::get_if<T>(&message)) found.push_back(*one);
  }
  return found;
}

/// Text of the error of type E that `action` throws; fails the test if it throws none or another one.
template <class E, class Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("WRONG TYPE: ") + error.what();
  }
  return "NO ERROR";
}

}  // namespace hoctomap::test
