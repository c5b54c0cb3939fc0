// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>
#include <system_error>

#include "Intrinsics.h"
#include "MatrixFile.h"
#include "hoctomap/dataset/Dataset.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"

namespace hoctomap {

namespace {

constexpr std::uint16_t kNoReturn = 65535;  // 7-Scenes; depthImage() takes 0 as none anyway
constexpr std::string_view kDepthEnding = ".depth.png";

/// Paths of the frames without their endings, by name.
std::vector<std::filesystem::path> framesOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) throw InputError(escapedText(folder.string()) + ": cannot be read: " + error.message());
  std::vector<std::filesystem::path> frames;
  for (const auto& entry : entries) {
    const std::string path = entry.path().string();
    if (path.ends_with(kDepthEnding)) frames.emplace_back(path.substr(0, path.size() - kDepthEnding.size()));
  }
  if (frames.empty()) throw InputError(escapedText(folder.string()) + ": holds no NAME.depth.png");
  std::sort(frames.begin(), frames.end());
  return frames;
}

Intrinsics readIntrinsics(const std::filesystem::path& folder) {
  const std::string name = "camera-intrinsics.txt";
  const auto above = std::filesystem::weakly_canonical(folder).parent_path() / name;
  std::error_code error;
  const bool here = std::filesystem::exists(folder / name, error);
  const auto file = here || !std::filesystem::exists(above, error) ? folder / name : above;
  if (!std::filesystem::exists(file, error))
    throw ConfigError(escapedText(file.string()) + ": is not there: give --intrinsics fx,fy,cx,cy");
  const auto m = readRows(file, "camera file", 3);
  return placed(escapedText(file.string()), [&] {
    if (m.size() != 3) throw InputError(std::to_string(m.size()) + " rows instead of 3");
    if (m[0][1] != 0.0 || m[1][0] != 0.0 || m[2] != std::vector<double>{0.0, 0.0, 1.0})
      throw InputError("is not of the form fx 0 cx, 0 fy cy, 0 0 1");
    const Intrinsics k{m[0][0], m[1][1], m[0][2], m[1][2]};
    checkIntrinsics(k);
    return k;
  });
}

/// Some recorders write a matrix of -inf for a frame whose pose was lost.
bool saysLost(const std::filesystem::path& file) {
  std::ifstream in = openText(file, "pose file");
  bool all = true;
  bool any = false;
  forEachLine(in, escapedText(file.string()), [&](std::string_view line, std::size_t) {
    for (const std::string_view word : wordsOf(line)) {
      any = true;
      all = all && word.starts_with("-inf");
    }
  });
  return any && all;
}

/// World <- optical frame; nothing if there is no pose.
std::optional<Pose> readPose(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) || saysLost(file)) return std::nullopt;
  const auto rows = readRows(file, "pose file", 4);
  return placed(escapedText(file.string()), [&] {
    if (rows.size() != 4) throw InputError(std::to_string(rows.size()) + " rows instead of 4");
    if (rows[3] != std::vector<double>{0.0, 0.0, 0.0, 1.0}) throw InputError("the last row is not 0 0 0 1");
    Eigen::Matrix<double, 3, 4> upper;
    for (int row = 0; row < 3; ++row)
      upper.row(row) = Eigen::Map<const Eigen::RowVector4d>(rows[static_cast<std::size_t>(row)].data());
    return nearestPose(upper);
  });
}

class FramesDataset final : public Dataset {
 public:
  explicit FramesDataset(const FramesOptions& options)
      : options_(options),
        frames_(framesOf(options.folder)),
        k_(options.intrinsics ? *options.intrinsics : readIntrinsics(options.folder)) {}

  [[nodiscard]] std::size_t size() const override { return frames_.size(); }

  [[nodiscard]] std::optional<Frame> frame(std::size_t i) override {
    const std::string stem = frames_.at(i).string();
    const auto world_T_optical = readPose(stem + ".pose.txt");
    if (!world_T_optical) return std::nullopt;
    const double stamp = static_cast<double>(i) / options_.rate_hz;
    DepthScan scan{i, stamp, "RGBD", *world_T_optical + opticalTSensor(), {}};
    const RawDepth raw = readDepthPng(stem + std::string(kDepthEnding));
    scan.image = placed(escapedText(stem) + std::string(kDepthEnding), [&] {
      size_.require(raw);
      return depthImage(raw, k_, depthUnit(), kNoReturn);
    });
    std::error_code error;
    if (const std::string colour = stem + ".color.png"; std::filesystem::exists(colour, error))
      scan.colour = readColourPng(colour);
    return scan;
  }

  [[nodiscard]] double depthUnit() const override { return 1.0 / options_.depth_factor; }

  [[nodiscard]] std::string description() const override {
    std::ostringstream text;
    text << "camera     " << textOf(k_) << ", depth 1/" << options_.depth_factor << " m\n";
    return text.str();
  }

 private:
  FramesOptions options_;
  std::vector<std::filesystem::path> frames_;
  Intrinsics k_;
  SequenceSize size_;
};

}  // namespace

std::unique_ptr<Dataset> openFrames(const FramesOptions& options) {
  return std::make_unique<FramesDataset>(options);
}

}  // namespace hoctomap
