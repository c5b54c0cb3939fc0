// SPDX-License-Identifier: BSD-3-Clause
#include "DatasetFolders.h"

#include <filesystem>
#include <iomanip>
#include <sstream>

#include "hoctomap/io/LabelPng.h"

namespace hoctomap::test {

namespace {

constexpr double kStart = 100.0;  // s
constexpr double kFrameSeconds = 0.1;

void writeDepth(const std::string& file, std::size_t k) {
  std::vector<std::uint16_t> steps(static_cast<std::size_t>(kSmallCamera.width * kSmallCamera.height));
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = depthSteps(k, i);
  writeLabelPng(file, kSmallCamera.width, kSmallCamera.height, steps);
}

std::string stampText(double stamp) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << stamp;
  return text.str();
}

}  // namespace

Pose worldTOptical(double stamp) {
  const double t = stamp - kStart;
  // A screw about the vertical axis: slerp and linear interpolation are exact between its poses.
  const Pose turned(0.3 * t, -0.1 * t, 1.2 + 0.05 * t, 0.4 + 0.5 * t, 0.0, 0.0);
  return turned + Pose(0.0, 0.0, 0.0, 0.2, 0.5, -1.9);
}

std::uint16_t depthSteps(std::size_t k, std::size_t i) {
  return i == 5 ? std::uint16_t{0} : static_cast<std::uint16_t>(5000 + 37 * i + 101 * k);
}

std::string tumRow(double stamp, const Pose& pose) {
  const Eigen::Quaterniond q(toIsometry(pose).linear());
  std::ostringstream row;
  row << std::fixed << std::setprecision(6) << stamp << std::setprecision(9);
  for (const double value : {pose.x(), pose.y(), pose.z(), q.x(), q.y(), q.z(), q.w()}) row << " " << value;
  row << "\n";
  return row.str();
}

void writeTumFolder(const std::string& folder, std::size_t frames) {
  std::filesystem::create_directories(folder + "/depth");
  std::filesystem::create_directories(folder + "/rgb");
  std::string depth = "# timestamp filename\n";
  std::string colour = "# timestamp filename\n";
  for (std::size_t k = 0; k < frames; ++k) {
    const double stamp = kStart + kFrameSeconds * static_cast<double>(k);
    const std::string image = "depth/" + std::to_string(k) + ".png";
    writeDepth(folder + "/" + image, k);
    depth += stampText(stamp) + " " + image + "\n";
    const std::string picture = "rgb/" + std::to_string(k) + ".png";
    writeGreyPng(folder + "/" + picture, 4, 3,
                 std::vector<std::uint8_t>(12, static_cast<std::uint8_t>(10 * k)));
    colour += stampText(stamp + 0.008) + " " + picture + "\n";
  }
  writeFile(folder + "/depth.txt", depth);
  writeFile(folder + "/rgb.txt", colour);
  std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
  for (double stamp = kStart - 0.013; stamp < kStart + kFrameSeconds * static_cast<double>(frames);
       stamp += 0.025)
    poses += tumRow(stamp, worldTOptical(stamp));
  writeFile(folder + "/groundtruth.txt", poses);
  writeFile(folder + "/camera.txt", "15 15.5 8 6.25 16 12 5000\n");
}

void writeFramesFolder(const std::string& folder, std::size_t frames) {
  std::filesystem::create_directories(folder);
  writeFile(folder + "/camera-intrinsics.txt", "15.0 0 8.0\n0 15.5 6.25\n0 0 1\n");
  for (std::size_t k = 0; k < frames; ++k) {
    const std::string stem = folder + "/frame-00000" + std::to_string(k);
    writeDepth(stem + ".depth.png", k);
    std::ostringstream matrix;
    matrix << std::fixed << std::setprecision(6)
           << toIsometry(worldTOptical(kStart + kFrameSeconds * static_cast<double>(k))).matrix() << "\n";
    writeFile(stem + ".pose.txt", matrix.str());
  }
}

}  // namespace hoctomap::test
