// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "Intrinsics.h"
#include "hoctomap/dataset/Dataset.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap {

namespace {

constexpr double kTumDepthFactor = 5000.0;  // steps a metre

/// An image of a list.
struct ListedImage {
  double stamp = 0.0;
  std::filesystem::path file;
  std::string place;  ///< list and line, for messages
};

/// Lists may name files of the folder only.
std::filesystem::path below(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path relative(name);
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
    throw InputError("'" + escapedText(name, 300) + "' leads out of the folder");
  return folder / relative;
}

std::vector<ListedImage> readList(const std::filesystem::path& folder, const std::string& list) {
  std::ifstream in = openText(folder / list, "list of images (a TUM RGB-D folder has one)");
  const std::string name = escapedText((folder / list).string());
  std::vector<ListedImage> images;
  forEachLine(in, name, [&](std::string_view line, std::size_t number) {
    const auto words = wordsOf(line);
    if (words.size() != 2)
      throw InputError(std::to_string(words.size()) + " columns instead of 2 (time and file)");
    const double stamp = numberFrom(words[0]);
    if (!images.empty() && stamp <= images.back().stamp) throw InputError("the times are not ascending");
    images.push_back({stamp, below(folder, words[1]), name + ":" + std::to_string(number)});
  });
  if (images.empty()) throw InputError(name + ": lists no image");
  return images;
}

struct CameraFile {
  Intrinsics k;
  int width = 0;
  int height = 0;
  std::optional<double> depth_factor;
};

std::optional<CameraFile> readCameraFile(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  std::ifstream in = openText(file, "camera file");
  std::optional<CameraFile> camera;
  forEachLine(in, escapedText(file.string()), [&](std::string_view line, std::size_t) {
    const auto v = numbersFrom(line);
    if (camera || (v.size() != 4 && v.size() != 6 && v.size() != 7))
      throw InputError("is not one line `fx fy cx cy [width height [depth_factor]]`");
    camera.emplace();
    camera->k = {v[0], v[1], v[2], v[3]};
    checkIntrinsics(camera->k);
    if (v.size() > 4) camera->width = static_cast<int>(v[4]);
    if (v.size() > 5) camera->height = static_cast<int>(v[5]);
    if (v.size() > 6) camera->depth_factor = v[6];
  });
  if (!camera) throw InputError(escapedText(file.string()) + ": holds no camera");
  return camera;
}

/// Folders of the benchmark are named after their camera: rgbd_dataset_freiburg1_desk.
std::optional<std::string> cameraInName(const std::filesystem::path& folder) {
  const std::string name = std::filesystem::weakly_canonical(folder).filename().string();
  for (const char* camera : {"freiburg1", "freiburg2", "freiburg3"}) {
    if (name.find(camera) != std::string::npos) return camera;
  }
  return std::nullopt;
}

class TumDataset final : public Dataset {
 public:
  explicit TumDataset(const TumOptions& options)
      : options_(options), depth_(readList(options.folder, "depth.txt")) {
    const auto poses = options.poses.empty() ? options.folder / "groundtruth.txt" : options.poses;
    track_ = readPoseFile(poses);
    chooseCamera();
    std::error_code error;
    if (std::filesystem::exists(options.folder / "rgb.txt", error))
      colour_ = readList(options.folder, "rgb.txt");
    requirePoses(poses);
  }

  [[nodiscard]] std::size_t size() const override { return depth_.size(); }

  [[nodiscard]] std::optional<Frame> frame(std::size_t i) override {
    const ListedImage& listed = depth_.at(i);
    const auto world_T_optical = poseAt(listed.stamp);
    if (!world_T_optical) return std::nullopt;
    DepthScan scan{i, listed.stamp, "RGBD", *world_T_optical + opticalTSensor(), {}};
    scan.image = placed(listed.place, [&] {
      const RawDepth raw = readDepthPng(listed.file);
      size_.require(raw);
      return depthImage(raw, k_, depthUnit(), 0);
    });
    if (const ListedImage* picture = pictureAt(listed.stamp))
      scan.colour = placed(picture->place, [&] { return readColourPng(picture->file); });
    return scan;
  }

  [[nodiscard]] double depthUnit() const override { return 1.0 / depth_factor_; }

  [[nodiscard]] std::string description() const override {
    std::ostringstream text;
    text << "camera     " << textOf(k_) << " (" << camera_from_ << "), depth 1/" << depth_factor_ << " m\n"
         << "poses      " << track_.size() << " in the trajectory\n";
    return text.str();
  }

 private:
  void chooseCamera() {
    const auto file = readCameraFile(options_.folder / "camera.txt");
    if (options_.intrinsics) {
      k_ = *options_.intrinsics;
      camera_from_ = "--intrinsics";
    } else if (file) {
      k_ = file->k;
      camera_from_ = "camera.txt";
      size_ = {file->width, file->height};
    } else if (const auto name = cameraInName(options_.folder)) {
      k_ = *namedCamera(*name);
      camera_from_ = *name + " by the name of the folder";
    } else {
      throw ConfigError(escapedText(options_.folder.string()) +
                        ": which camera? There is no camera.txt: give --intrinsics fx,fy,cx,cy or one of "
                        "freiburg1, freiburg2, freiburg3, kinect");
    }
    depth_factor_ = options_.depth_factor        ? *options_.depth_factor
                    : file && file->depth_factor ? *file->depth_factor
                                                 : kTumDepthFactor;
    if (!(depth_factor_ > 0.0)) throw InputError("the depth factor is not positive");
  }

  void requirePoses(const std::filesystem::path& poses) const {
    if (std::any_of(depth_.begin(), depth_.end(), [&](const auto& d) { return poseAt(d.stamp).has_value(); }))
      return;
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << escapedText(poses.string())
         << ": has no pose at the time of any image: it goes from "
         << track_.firstStamp() + options_.time_offset_s << " to "
         << track_.lastStamp() + options_.time_offset_s << " s, the images from " << depth_.front().stamp
         << " to " << depth_.back().stamp << " s (--time-offset shifts it, --max-gap is "
         << options_.max_gap_s << " s)";
    throw InputError(text.str());
  }

  [[nodiscard]] std::optional<Pose> poseAt(double stamp) const {
    return track_.at(stamp - options_.time_offset_s, options_.max_gap_s);
  }

  /// The picture nearest in time; null if none is near enough.
  [[nodiscard]] const ListedImage* pictureAt(double stamp) const {
    const auto distance = [&](const ListedImage& a) { return std::abs(a.stamp - stamp); };
    auto after = std::lower_bound(colour_.begin(), colour_.end(), stamp,
                                  [](const ListedImage& a, double t) { return a.stamp < t; });
    auto nearest = after;
    if (after != colour_.begin() &&
        (after == colour_.end() || distance(*std::prev(after)) < distance(*after)))
      nearest = std::prev(after);
    if (nearest == colour_.end() || distance(*nearest) > options_.tolerance_s) return nullptr;
    return &*nearest;
  }

  TumOptions options_;
  std::vector<ListedImage> depth_;
  std::vector<ListedImage> colour_;
  PoseTrack track_;
  Intrinsics k_;
  std::string camera_from_;
  SequenceSize size_;
  double depth_factor_ = kTumDepthFactor;
};

}  // namespace

std::unique_ptr<Dataset> openTum(const TumOptions& options) {
  return std::make_unique<TumDataset>(options);
}

}  // namespace hoctomap
