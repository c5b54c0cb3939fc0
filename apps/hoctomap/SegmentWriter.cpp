// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentWriter.h"

#include <Eigen/Geometry>
#include <iomanip>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/LabelPng.h"
#include "hoctomap/tabletop/LabelImage.h"

namespace hoctomap {

namespace {

std::string scanName(std::uint64_t scan, const std::string& extension) {
  std::ostringstream name;
  name << std::setw(6) << std::setfill('0') << scan << extension;
  return name.str();
}

}  // namespace

SegmentWriter::SegmentWriter(const std::filesystem::path& directory, bool overwrite) : directory_(directory) {
  std::error_code error;
  if (!overwrite && std::filesystem::exists(directory) && !std::filesystem::is_empty(directory, error)) {
    throw ConfigError(directory.string() + ": not empty (use --overwrite)");
  }
  if (overwrite) std::filesystem::remove_all(directory / "labels", error);
  std::filesystem::create_directories(directory / "labels", error);
  if (error) throw FileError((directory / "labels").string() + ": " + error.message());
  rows_ = "scan,segment,label,points,cx,cy,cz,hx,hy,hz\n";
}

void SegmentWriter::write(const Measurement& z, std::span<const Segment> segments,
                          const LabelingFunction& labeling) {
  if (z.image) {
    writeLabelPng(directory_ / "labels" / scanName(z.scan, ".png"), z.image->camera.width,
                  z.image->camera.height, labelImage(z, segments));
  } else {
    std::string values;
    for (const auto value : labelPoints(z, segments)) values += std::to_string(value) + "\n";
    writeTextFile(directory_ / "labels" / scanName(z.scan, ".csv"), values);
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (const auto p : segments[i].points) box.extend(z.world_points[p].cast<double>());
    if (box.isEmpty()) continue;
    rows_ += std::to_string(z.scan) + "," + std::to_string(i) + "," + labeling.label(z, segments[i]).name +
             "," + std::to_string(segments[i].points.size());
    appendVector(rows_, box.center());
    appendVector(rows_, 0.5 * box.sizes());
    rows_ += "\n";
  }
}

void SegmentWriter::finish() {
  writeTextFile(directory_ / "segments.csv", rows_);
}

}  // namespace hoctomap
