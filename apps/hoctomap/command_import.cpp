// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include "Command.h"
#include "Progress.h"
#include "hoctomap/dataset/Dataset.h"
#include "hoctomap/dataset/Level.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/PipeLogWriter.h"

namespace hoctomap {

namespace {

const CLI::Range kDepthFactors(1e-3, 1e9);  // steps a metre
const CLI::Range kRates(1e-3, 1e6);         // Hz
constexpr double kMaxSkippedShare = 0.05;   // as [limits] max_skipped_share of `build`

/// What the three formats have in common.
struct ImportOptions {
  std::string source;
  std::string log;
  std::vector<double> up;
  bool level = false;
  double floor = 0.0;
  bool external_images = false;
  bool quiet = false;
};

/// Turns the data set's world into one whose z is up, and says what by.
Pose levelWorld(Dataset& dataset, const ImportOptions& options, std::string& said) {
  if (!std::isfinite(options.floor)) throw ConfigError("--floor: must be finite");
  Pose level_T_world;
  if (!options.up.empty()) {
    try {
      level_T_world = levelled({options.up[0], options.up[1], options.up[2]});
    } catch (const std::invalid_argument& what) {
      throw ConfigError(std::string("--up: ") + what.what());
    }
  }
  if (options.level) {
    const LargestLevel largest = largestLevel(dataset);
    level_T_world = largest.level_T_world;
    const Eigen::Vector3d up = toIsometry(level_T_world).linear().row(2);
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << "level      up is " << up.x() << "," << up.y() << ","
         << up.z() << std::setprecision(3) << "; the largest structure, " << std::setprecision(2)
         << largest.area << " m^2, is at z = " << std::setprecision(3) << largest.height - options.floor
         << " m\n";
    said = text.str();
  }
  return Pose(0.0, 0.0, -options.floor, 0.0, 0.0, 0.0) + level_T_world;
}

struct Counts {
  std::uint64_t scans = 0;
  std::uint64_t coloured = 0;
  std::uint64_t without_pose = 0;
};

/// A frame as it stands in the log: the pose in the world, and the sensor at it.
void writeFrame(PipeLogWriter& writer, Dataset::Frame frame, const Pose& level_T_world, Counts& counts) {
  std::visit(
      [&](auto& scan) {
        scan.world_T_sensor = orthonormalized(level_T_world + scan.world_T_sensor);
        scan.scan = counts.scans++;
        writer.write(TruthPose{scan.stamp, "groundtruth", scan.world_T_sensor});
        if constexpr (requires { scan.colour; }) {
          if (!scan.colour.empty()) ++counts.coloured;
        } else {
          if (!scan.colours.empty()) ++counts.coloured;
        }
        writer.write(std::move(scan));
      },
      frame);
}

int import(Dataset& dataset, const ImportOptions& options) {
  std::string level_text;
  const Pose level_T_world = levelWorld(dataset, options, level_text);
  RunLog log(0, options.quiet);
  Progress progress(log, dataset.size(), options.quiet);
  PipeLogWriter writer(options.log, dataset.depthUnit(), options.external_images);
  Counts counts;
  for (std::size_t i = 0; i < dataset.size(); ++i) {
    if (auto frame = dataset.frame(i)) {
      writeFrame(writer, std::move(*frame), level_T_world, counts);
    } else {
      ++counts.without_pose;
    }
    progress.show(i + 1, std::nullopt);
  }
  if (counts.scans == 0) throw InputError(options.source + ": no frame has a pose");
  writer.finish();
  progress.finish();
  std::cout << dataset.description() << level_text << "log        " << options.log << " (" << counts.scans
            << " scans, " << counts.coloured << " with colour, " << counts.without_pose
            << " frames skipped)\n";
  if (counts.without_pose > 0) std::cout << "           " << counts.without_pose << " x no pose\n";
  std::cout << std::flush;
  if (static_cast<double>(counts.without_pose) <= kMaxSkippedShare * static_cast<double>(dataset.size()))
    return 0;
  log.warn("more than 5 % of the frames have no pose; the log holds the others");
  return 3;
}

void addCommonOptions(CLI::App& format, ImportOptions& options) {
  format.add_option("source", options.source, "folder of the data set")->type_name("SRC")->required();
  format.add_option("-o,--output", options.log, "the log")->type_name("LOG")->required();
  auto* up = format.add_option("--up", options.up, "what points up in the data set's world (default: 0,0,1)")
                 ->type_name("X,Y,Z")
                 ->delimiter(',')
                 ->expected(3);
  format
      .add_flag("--level", options.level, "turn the world so that the largest horizontal structure is level")
      ->excludes(up);
  format.add_option("--floor", options.floor, "z of the floor in the upright world, metres: it becomes 0")
      ->type_name("Z");
  format.add_flag("-q,--quiet", options.quiet, "say only warnings and errors");
}

void addImages(CLI::App& format, ImportOptions& options) {
  const std::map<std::string, bool> where{{"embedded", false}, {"external", true}};
  format
      .add_option("--images", options.external_images,
                  "embedded: in the log (default), external: as files in LOG_Images beside it")
      ->type_name("WHERE")
      ->transform(CLI::CheckedTransformer(where));
}

CLI::Option* addIntrinsics(CLI::App& format, std::string& text) {
  return format
      .add_option("--intrinsics", text,
                  "of the depth images: fx,fy,cx,cy, or freiburg1, freiburg2, freiburg3, kinect")
      ->type_name("K");
}

void addMaxGap(CLI::App& format, double& seconds) {
  format.add_option("--max-gap", seconds, "longest gap between poses to interpolate over, seconds")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
}

void addTum(CLI::App& import_command, Action& action) {
  struct Options : ImportOptions {
    TumOptions tum{};
    std::string intrinsics;
    double depth_factor = 0.0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* format = addCommand(import_command, "tum", "A folder of the TUM RGB-D benchmark, or one like it",
                                {"hoctomap import tum rgbd_dataset_freiburg1_desk -o desk.rawlog"});
  addCommonOptions(*format, *options);
  addImages(*format, *options);
  addIntrinsics(*format, options->intrinsics);
  format
      ->add_option("--depth-factor", options->depth_factor,
                   "steps of the depth images a metre (default: 5000)")
      ->type_name("N")
      ->check(kDepthFactors);
  format->add_option("--poses", options->tum.poses, "trajectory (default: groundtruth.txt)")
      ->type_name("FILE");
  addMaxGap(*format, options->tum.max_gap_s);
  format
      ->add_option("--tolerance", options->tum.tolerance_s, "between a depth image and its picture, seconds")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  format->add_option("--time-offset", options->tum.time_offset_s,
                     "added to the times of the trajectory, seconds");
  format->callback([options, &action] {
    action = [options] {
      options->tum.folder = options->source;
      if (!options->intrinsics.empty()) options->tum.intrinsics = intrinsicsFrom(options->intrinsics);
      if (options->depth_factor > 0.0) options->tum.depth_factor = options->depth_factor;
      return import(*openTum(options->tum), *options);
    };
  });
}

void addFrames(CLI::App& import_command, Action& action) {
  struct Options : ImportOptions {
    FramesOptions frames{};
    std::string intrinsics;
  };
  auto options = std::make_shared<Options>();
  CLI::App* format = addCommand(
      import_command, "frames", "Images with a pose file each, as of 7-Scenes and tsdf-fusion",
      {"hoctomap import frames redkitchen/seq-01 --intrinsics 585,585,320,240 --level -o kitchen.rawlog"});
  addCommonOptions(*format, *options);
  addImages(*format, *options);
  addIntrinsics(*format, options->intrinsics);
  format->add_option("--depth-factor", options->frames.depth_factor, "steps of the depth images a metre")
      ->type_name("N")
      ->capture_default_str()
      ->check(kDepthFactors);
  format->add_option("--rate", options->frames.rate_hz, "frames a second: the files say no times")
      ->capture_default_str()
      ->check(kRates);
  format->callback([options, &action] {
    action = [options] {
      options->frames.folder = options->source;
      if (!options->intrinsics.empty()) options->frames.intrinsics = intrinsicsFrom(options->intrinsics);
      return import(*openFrames(options->frames), *options);
    };
  });
}

void addPcd(CLI::App& import_command, Action& action) {
  struct Options : ImportOptions {
    CloudOptions clouds{};
  };
  auto options = std::make_shared<Options>();
  CLI::App* format = addCommand(
      import_command, "pcd", "A folder of .pcd, .ply or KITTI .bin clouds, and a trajectory",
      {"hoctomap import pcd clouds --poses trajectory.txt -o clouds.rawlog",
       "hoctomap import pcd sequences/00/velodyne --poses poses/00.txt --up 0,-1,0 -o kitti.rawlog"});
  addCommonOptions(*format, *options);
  format
      ->add_option(
          "--poses", options->clouds.poses,
          "TUM (8 columns), MRPT (7) or KITTI (12) (default: poses.txt, groundtruth.txt, trajectory.txt)")
      ->type_name("FILE");
  format
      ->add_option("--times", options->clouds.times,
                   "seconds, a line a cloud (default: times.txt, else the clouds' names)")
      ->type_name("FILE");
  format
      ->add_option("--calib", options->clouds.calib,
                   "KITTI's calibration with the sensor's place, Tr (default: calib.txt)")
      ->type_name("FILE");
  addMaxGap(*format, options->clouds.max_gap_s);
  format->add_option("--rate", options->clouds.rate_hz, "clouds a second where no times are given")
      ->capture_default_str()
      ->check(kRates);
  format->callback([options, &action] {
    action = [options] {
      options->clouds.folder = options->source;
      return import(*openClouds(options->clouds), *options);
    };
  });
}

}  // namespace

void addImportCommand(CLI::App& app, Action& action) {
  CLI::App* command = addCommand(
      app, "import", "Make a log of a data set of another format",
      {"hoctomap import tum rgbd_dataset_freiburg1_desk -o desk.rawlog", "hoctomap import frames --help"});
  command->require_subcommand(1);
  addTum(*command, action);
  addFrames(*command, action);
  addPcd(*command, action);
}

}  // namespace hoctomap
