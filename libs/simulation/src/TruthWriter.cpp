// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/TruthWriter.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/LabelPng.h"

namespace hoctomap {
namespace {

constexpr const char* kPosesHeader =
    "scan,object,label,present,visible_pixels,x,y,z,yaw,pitch,roll,cx,cy,cz,hx,hy,hz,bx,by,bz,"
    "seen_voxels,sx,sy,sz,value\n";

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot make the folder: " + error.message());
}

std::string objectTable(const Scene& scene) {
  std::string text = "value,object,label\n0,,no return\n1,,background\n";
  for (const SolidId id : scene.ids()) {
    const Solid& solid = scene.solid(id);
    if (solid.label == SolidLabel::background) continue;
    text += std::to_string(scene.pixelValue(id)) + ',' + solid.name + ',';
    text += toString(solid.label);
    text += '\n';
  }
  return text;
}

std::string imageName(std::uint64_t scan) {
  char name[32];
  std::snprintf(name, sizeof name, "%06llu.png", static_cast<unsigned long long>(scan));
  return name;
}

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

}  // namespace

TruthWriter::TruthWriter(const std::filesystem::path& folder, const Scene& scene)
    : folder_(folder), poses_(kPosesHeader) {
  makeFolder(folder_ / "labels");
  writeTextFile(folder_ / "objects.csv", objectTable(scene));
}

void TruthWriter::write(const SimulatedScan& scan) {
  writeLabelPng(folder_ / "labels" / imageName(scan.scan), scan.image.camera.width, scan.image.camera.height,
                scan.labels);
  seen_.add(scan);
  for (const SolidId id : scan.scene.ids())
    if (scan.scene.solid(id).label != SolidLabel::background) appendPose(scan, id);
}

void TruthWriter::finish() {
  writeTextFile(folder_ / "poses.csv", poses_);
}

void TruthWriter::appendPose(const SimulatedScan& scan, SolidId id) {
  const Solid& solid = scan.scene.solid(id);
  const Pose world_T_solid = scan.scene.world_T_solid(id);
  const SurfaceExtent extent = surfaceExtent(*solid.surface, toIsometry(world_T_solid));
  const auto visible = std::count(scan.labels.begin(), scan.labels.end(), scan.scene.pixelValue(id));

  poses_ += std::to_string(scan.scan) + ',' + solid.name + ',';
  poses_ += toString(solid.label);
  poses_ += scan.scene.present(id) ? ",1," : ",0,";
  poses_ += std::to_string(visible);
  appendVector(poses_, {world_T_solid.x(), world_T_solid.y(), world_T_solid.z()});
  appendVector(poses_,
               {degrees(world_T_solid.yaw()), degrees(world_T_solid.pitch()), degrees(world_T_solid.roll())});
  appendVector(poses_, extent.centroid);
  appendVector(poses_, 0.5 * extent.box.sizes());
  appendVector(poses_, extent.box.center());
  poses_ += ',' + std::to_string(seen_.voxels(id));
  if (const auto seen = seen_.centroid(id))
    appendVector(poses_, toIsometry(world_T_solid) * *seen);
  else
    poses_ += ",,,";
  poses_ += ',' + std::to_string(scan.scene.pixelValue(id)) + '\n';
}

}  // namespace hoctomap
