// SPDX-License-Identifier: BSD-3-Clause
// What scripts/python_figures.py compares the Python package with: the same work, done by a program of C++.
// Prints the seconds of user time that the work itself took, all threads together.
//   hoctomap-python-baseline points MAP POINTS        POINTS: doubles, three a point
//   hoctomap-python-baseline mapping FOLDER           FOLDER: K.depth (float, 640 x 480), K.pose (double, 4 x
//   4 by rows)
#include <sys/resource.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "MappingSetup.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {
namespace {

double userSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

template <typename Value>
std::vector<Value> readValues(const std::filesystem::path& file) {
  std::vector<Value> values(std::filesystem::file_size(file) / sizeof(Value));
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(values.size() * sizeof(Value)));
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return values;
}

double askPoints(const std::filesystem::path& map, const std::filesystem::path& file) {
  const StoredMap stored = readMap(map);
  const HierarchyQuery query(stored.hierarchy);
  const auto points = readValues<Eigen::Vector3d>(file);
  const double start = userSeconds();
  std::vector<PointAnswer> answers(points.size());
  query.at(points, answers);
  return userSeconds() - start;
}

double mapScans(const std::filesystem::path& folder) {
  std::vector<std::vector<float>> depths;
  std::vector<Pose> poses;
  for (std::size_t k = 0; std::filesystem::exists(folder / (std::to_string(k) + ".depth")); ++k) {
    depths.push_back(readValues<float>(folder / (std::to_string(k) + ".depth")));
    const auto pose = readValues<double>(folder / (std::to_string(k) + ".pose"));
    poses.push_back(
        poseFromMatrix(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data())));
  }
  const Settings settings = loadSettings(std::nullopt);
  const double start = userSeconds();
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, makeStrategies(settings));
  for (std::size_t k = 0; k < depths.size(); ++k) {
    Measurement z = unproject({{640, 480, 520.0, 520.0, 319.5, 239.5}, depths[k]}, poses[k], {});
    z.scan = k;
    mapper.integrate(z);
  }
  mapper.finish(depths.size() - 1, 0.0);
  const double seconds = userSeconds() - start;
  std::cerr << mapper.hierarchy().size() << " nodes\n";
  return seconds;
}

}  // namespace
}  // namespace hoctomap

int main(int argc, char** argv) {
  const std::string task = argc > 1 ? argv[1] : "";
  if (task == "points" && argc == 4) std::cout << hoctomap::askPoints(argv[2], argv[3]) << "\n";
  if (task == "mapping" && argc == 3) std::cout << hoctomap::mapScans(argv[2]) << "\n";
}
