// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <sstream>
#include <system_error>

#include "CloudReader.h"
#include "Intrinsics.h"
#include "MatrixFile.h"
#include "hoctomap/dataset/Dataset.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/NumberLines.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap {

namespace {

constexpr std::size_t kKittiColumns = 12;

std::vector<std::filesystem::path> cloudsOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) throw InputError(escapedText(folder.string()) + ": cannot be read: " + error.message());
  std::vector<std::filesystem::path> clouds;
  for (const auto& entry : entries) {
    const auto extension = entry.path().extension();
    if (extension == ".pcd" || extension == ".ply" || extension == ".bin") clouds.push_back(entry.path());
  }
  if (clouds.empty()) throw InputError(escapedText(folder.string()) + ": holds no .pcd, .ply or .bin file");
  std::sort(clouds.begin(), clouds.end());
  return clouds;
}

/// The file asked for, else the first of `names` that is in the folder or, as KITTI has it, above.
std::filesystem::path chosenFile(const std::filesystem::path& asked, const std::filesystem::path& folder,
                                 const std::vector<std::string>& names) {
  if (!asked.empty()) return asked;
  std::error_code error;
  for (const auto& place : {folder, std::filesystem::weakly_canonical(folder).parent_path()}) {
    for (const auto& name : names) {
      if (std::filesystem::exists(place / name, error)) return place / name;
    }
  }
  return {};
}

std::size_t columnsOf(const std::filesystem::path& file) {
  std::ifstream in = openText(file, "trajectory");
  std::size_t columns = 0;
  forEachLine(in, escapedText(file.string()), [&](std::string_view line, std::size_t) {
    if (columns == 0) columns = wordsOf(line).size();
  });
  return columns;
}

/// All of a name as a number: of a cloud in KITTI's folders, or the time of one.
template <class Number>
std::optional<Number> numberInName(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  Number value{};
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), value);
  if (error != std::errc{} || end != stem.data() + stem.size()) return std::nullopt;
  return value;
}

std::vector<double> readTimes(const std::filesystem::path& file) {
  std::vector<double> times;
  for (const auto& row : readRows(file, "file of times", 1)) {
    if (!times.empty() && row[0] <= times.back())
      throw InputError(escapedText(file.string()) + ": the times are not ascending");
    times.push_back(row[0]);
  }
  return times;
}

/// KITTI's `Tr: ` line: velodyne in the frame of the camera that the poses are of.
std::optional<Pose> readMounting(const std::filesystem::path& file) {
  std::ifstream in = openText(file, "calibration");
  std::optional<Pose> mounting;
  forEachLine(in, escapedText(file.string()), [&](std::string_view line, std::size_t) {
    for (const std::string_view key : {"Tr:", "Tr_velo_to_cam:"}) {
      if (!line.starts_with(key)) continue;
      const auto row = numbersFrom(line.substr(key.size()));
      if (row.size() != kKittiColumns)
        throw InputError(std::to_string(row.size()) + " numbers instead of " + std::to_string(kKittiColumns));
      mounting = poseFromRow(row);
    }
  });
  return mounting;
}

class CloudDataset final : public Dataset {
 public:
  explicit CloudDataset(const CloudOptions& options) : options_(options), clouds_(cloudsOf(options.folder)) {
    readTrajectory();
    const auto times = chosenFile(options.times, options.folder, {"times.txt"});
    if (!times.empty()) times_ = readTimes(times);
    if (!times.empty()) times_from_ = escapedText(times.string());
    const auto calib = chosenFile(options.calib, options.folder, {"calib.txt"});
    if (!calib.empty()) mounting_ = readMounting(calib);
    if (!options.calib.empty() && !mounting_)
      throw InputError(escapedText(calib.string()) + ": has no line Tr:");
    requirePoses();
  }

  [[nodiscard]] std::size_t size() const override { return clouds_.size(); }

  [[nodiscard]] std::optional<Frame> frame(std::size_t i) override {
    const auto pose = poseOf(i);
    if (!pose) return std::nullopt;
    CloudScan scan = reader_.read(clouds_[i]);
    scan.scan = i;
    scan.stamp = stampOf(i);
    scan.sensor = "cloud";
    scan.world_T_sensor = mounting_ ? *pose + *mounting_ : *pose;
    return scan;
  }

  [[nodiscard]] std::string description() const override {
    std::ostringstream text;
    text << "poses      " << (kitti_.empty() ? track_.size() : kitti_.size()) << " in "
         << escapedText(trajectory_.string()) << ", "
         << (kitti_.empty() ? "by time" : "by the number of the cloud") << "\n";
    if (mounting_) text << "mounting   by the calibration's Tr\n";
    return text.str();
  }

 private:
  void readTrajectory() {
    trajectory_ =
        chosenFile(options_.poses, options_.folder, {"poses.txt", "groundtruth.txt", "trajectory.txt"});
    if (trajectory_.empty())
      throw InputError(escapedText(options_.folder.string()) +
                       ": no poses.txt, groundtruth.txt or trajectory.txt: give --poses FILE");
    if (columnsOf(trajectory_) != kKittiColumns) {
      track_ = readPoseFile(trajectory_);
      return;
    }
    std::ifstream in = openText(trajectory_, "trajectory");
    forEachLine(in, escapedText(trajectory_.string()), [&](std::string_view line, std::size_t) {
      const auto row = numbersFrom(line);
      if (row.size() != kKittiColumns)
        throw InputError(std::to_string(row.size()) + " columns after lines of 12");
      kitti_.push_back(poseFromRow(row));
    });
  }

  /// Row of a cloud in trajectory and times: its name if it is a number, else its place.
  [[nodiscard]] std::size_t rowOf(std::size_t i) const {
    return numberInName<std::uint32_t>(clouds_[i]).value_or(static_cast<std::uint32_t>(i));
  }

  [[nodiscard]] double stampOf(std::size_t i) const {
    const std::size_t row = rowOf(i);
    if (!times_.empty()) {
      if (row < times_.size()) return times_[row];
      throw InputError(times_from_ + ": has no line for " + escapedText(clouds_[i].string()));
    }
    if (kitti_.empty()) {
      if (const auto stamp = numberInName<double>(clouds_[i])) return *stamp;
      throw InputError(escapedText(clouds_[i].string()) +
                       ": has no time: the name is no number; give --times");
    }
    return static_cast<double>(row) / options_.rate_hz;
  }

  [[nodiscard]] std::optional<Pose> poseOf(std::size_t i) const {
    if (kitti_.empty()) return track_.at(stampOf(i), options_.max_gap_s);
    const std::size_t row = rowOf(i);
    if (row >= kitti_.size()) return std::nullopt;
    return kitti_[row];
  }

  void requirePoses() const {
    for (std::size_t i = 0; i < clouds_.size(); ++i) {
      if (poseOf(i)) return;
    }
    throw InputError(escapedText(trajectory_.string()) +
                     ": has no pose for any of the clouds: are its times theirs? (--times, --max-gap)");
  }

  CloudOptions options_;
  std::vector<std::filesystem::path> clouds_;
  std::filesystem::path trajectory_;
  PoseTrack track_;
  std::vector<Pose> kitti_;  ///< by number; else `track_` holds
  std::vector<double> times_;
  std::string times_from_;
  std::optional<Pose> mounting_;  ///< of the sensor on what the poses are of
  CloudReader reader_;
};

}  // namespace

std::unique_ptr<Dataset> openClouds(const CloudOptions& options) {
  return std::make_unique<CloudDataset>(options);
}

}  // namespace hoctomap
