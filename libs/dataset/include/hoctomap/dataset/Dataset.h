// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// Scans of a folder that is no log: images or clouds in files, and a trajectory. What the folder lists is
/// read and checked when it is opened, the scans themselves one by one, when they are asked for.
class Dataset {
 public:
  using Frame = std::variant<DepthScan, CloudScan>;

  Dataset() = default;
  Dataset(const Dataset&) = delete;
  Dataset& operator=(const Dataset&) = delete;
  virtual ~Dataset() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;

  /// Frame `i` in the world of the trajectory, which may have any axis up; nothing if the trajectory has no
  /// pose for it.
  /// @throws InputError naming file and line, LimitError for images and clouds of more than 10^7 points.
  [[nodiscard]] virtual std::optional<Frame> frame(std::size_t i) = 0;

  /// Metres a step of the depth images, whatever is a frame.
  [[nodiscard]] virtual double depthUnit() const { return 0.001; }

  /// Cameras and poses, for the user; lines that end in a newline.
  [[nodiscard]] virtual std::string description() const = 0;
};

/// Focal lengths and principal point in pixels.
struct Intrinsics {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// Text `fx,fy,cx,cy`, or one of the cameras of the TUM benchmark by name: `freiburg1`, `freiburg2`,
/// `freiburg3`, `kinect` (what its tools take when nothing is known). @throws ConfigError
[[nodiscard]] Intrinsics intrinsicsFrom(const std::string& text);

struct TumOptions {
  std::filesystem::path folder;
  std::filesystem::path poses{};  ///< default: groundtruth.txt of the folder
  std::optional<Intrinsics>
      intrinsics;                      ///< default: camera.txt, else the name of the folder says which camera
  std::optional<double> depth_factor;  ///< steps a metre; default: camera.txt, else 5000
  double tolerance_s = 0.02;           ///< between a depth image and its picture
  double max_gap_s = 0.5;              ///< between the poses to interpolate between
  double time_offset_s = 0.0;          ///< added to the times of the trajectory
};

/// A folder as the TUM RGB-D benchmark has it: `depth.txt`, perhaps `rgb.txt`, `groundtruth.txt`; 16-bit
/// depth images in register with the pictures. `camera.txt`, if it is there: a line `fx fy cx cy [width
/// height [depth_factor]]`. Poses are those of the optical frame (z forward), interpolated at the time of the
/// depth image.
/// @throws InputError, ConfigError
[[nodiscard]] std::unique_ptr<Dataset> openTum(const TumOptions& options);

struct FramesOptions {
  std::filesystem::path folder;
  std::optional<Intrinsics> intrinsics;  ///< default: camera-intrinsics.txt of the folder or the one above
  double depth_factor = 1000.0;          ///< steps a metre
  double rate_hz = 30.0;                 ///< frames have no times: frame k is taken at k / rate
};

/// A folder of `NAME.depth.png`, `NAME.pose.txt` (4x4, optical frame in the world) and perhaps
/// `NAME.color.png`, as 7-Scenes and tsdf-fusion have them. Depths of 0 and 65535 are no return.
/// @throws InputError, ConfigError
[[nodiscard]] std::unique_ptr<Dataset> openFrames(const FramesOptions& options);

struct CloudOptions {
  std::filesystem::path folder;
  std::filesystem::path poses{};  ///< default: poses.txt or groundtruth.txt of the folder
  std::filesystem::path
      times{};  ///< seconds, a line a cloud; default: times.txt, else the names of the clouds
  std::filesystem::path
      calib{};  ///< with a line `Tr:` (KITTI), the sensor on what the poses are of; calib.txt
  double max_gap_s = 0.5;
  double rate_hz = 10.0;  ///< of clouds that have no times
};

/// A folder of `.pcd`, `.ply` or KITTI `.bin` clouds in the sensor's frame, in the order of their names, with
/// a trajectory: TUM (8 columns) or MRPT (7) by time, or KITTI (12) by number. The files are read by the
/// helper `hoctomap-cloud`.
/// @throws InputError, ConfigError
[[nodiscard]] std::unique_ptr<Dataset> openClouds(const CloudOptions& options);

}  // namespace hoctomap
