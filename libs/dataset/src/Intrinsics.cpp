// SPDX-License-Identifier: BSD-3-Clause
#include "Intrinsics.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"

namespace hoctomap {

std::optional<Intrinsics> namedCamera(const std::string& name) {
  // Depth images of the benchmark are in register with the colour camera, so that its calibration holds:
  // J. Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, IROS 2012, and its web pages.
  static const std::map<std::string, Intrinsics> cameras{{"freiburg1", {517.3, 516.5, 318.6, 255.3}},
                                                         {"freiburg2", {520.9, 521.0, 325.1, 249.7}},
                                                         {"freiburg3", {535.4, 539.2, 320.1, 247.6}},
                                                         {"kinect", {525.0, 525.0, 319.5, 239.5}}};
  const auto found = cameras.find(name);
  if (found == cameras.end()) return std::nullopt;
  return found->second;
}

void checkIntrinsics(const Intrinsics& k) {
  if (k.fx <= 0.0 || k.fy <= 0.0) throw InputError("the focal lengths must be positive");
}

Intrinsics intrinsicsFrom(const std::string& text) {
  if (const auto camera = namedCamera(text)) return *camera;
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  try {
    const auto v = numbersFrom(spaced);
    if (v.size() != 4) throw InputError("not four numbers");
    const Intrinsics k{v[0], v[1], v[2], v[3]};
    checkIntrinsics(k);
    return k;
  } catch (const InputError& what) {
    throw ConfigError("--intrinsics " + escapedText(text, 100) + ": " + what.what() +
                      "; give fx,fy,cx,cy or freiburg1, freiburg2, freiburg3, kinect");
  }
}

PinholeCamera cameraFor(const Intrinsics& k, int width, int height) {
  if (k.cx < 0.0 || k.cy < 0.0 || k.cx > width || k.cy > height)
    throw InputError("the principal point (" + textOf(k) + ") is outside of the image of " +
                     std::to_string(width) + " x " + std::to_string(height));
  return {width, height, k.fx, k.fy, k.cx, k.cy};
}

DepthImage depthImage(const RawDepth& raw, const Intrinsics& k, double unit, std::uint16_t no_return) {
  DepthImage image{cameraFor(k, raw.width, raw.height), std::vector<float>(raw.steps.size())};
  for (std::size_t i = 0; i < raw.steps.size(); ++i) {
    const std::uint16_t steps = raw.steps[i];
    image.depth[i] = steps == no_return ? 0.0F : static_cast<float>(unit * steps);
  }
  return image;
}

Pose opticalTSensor() {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return poseFromMatrix(m);
}

std::string textOf(const Intrinsics& k) {
  std::ostringstream text;
  text << k.fx << " " << k.fy << " " << k.cx << " " << k.cy;
  return text.str();
}

}  // namespace hoctomap
