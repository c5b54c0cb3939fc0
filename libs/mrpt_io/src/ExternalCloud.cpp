// SPDX-License-Identifier: BSD-3-Clause
#include "ExternalCloud.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "ExternalBytes.h"
#include "ExternalFiles.h"
#include "ScanConverter.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/NumberLines.h"
#include "hoctomap/mrpt_io/LogFileStream.h"

namespace hoctomap {

using mrpt::obs::CObservationPointCloud;

namespace {

/// For those who open by name: the file that was found to lie in the folder, and no other.
std::filesystem::path nameOf(const ExternalFile& file) {
  return "/proc/self/fd/" + std::to_string(file.descriptor());
}

std::optional<PointCloud> readMap(const ExternalFile& file) {
  ReadProgress nobody_asks;
  try {
    LogFileStream stream(nameOf(file), LogReadOptions(), nobody_asks);
    const auto object = mrpt::serialization::archiveFrom(stream).ReadObject();
    const auto* map = dynamic_cast<const mrpt::maps::CPointsMap*>(object.get());
    if (map == nullptr || !stream.atEnd()) return std::nullopt;
    checkPoints(map->size());
    PointCloud points(map->size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {map->getPointsBufferRef_x()[i], map->getPointsBufferRef_y()[i],
                   map->getPointsBufferRef_z()[i]};
    }
    return points;
  } catch (const LimitError&) {
    throw;
  } catch (const std::exception&) {  // MRPT's, also for memory that a count asks for
    return std::nullopt;
  }
}

std::optional<PointCloud> readRecords(const ExternalFile& file) {
  ExternalBytes bytes(file);
  PointCloud points;
  std::array<float, 4> record{};  // x, y, z, intensity
  std::size_t size = 0;
  while ((size = bytes.readSome(record.data(), sizeof record)) == sizeof record) {
    points.emplace_back(record[0], record[1], record[2]);
    checkPoints(points.size());
  }
  if (size != 0 || !bytes.atEnd()) return std::nullopt;
  return points;
}

float coordinateFrom(std::string_view word) {
  float value = 0.F;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) throw InputError("not a number");
  return value;
}

std::optional<PointCloud> readText(const ExternalFile& file) {
  PointCloud points;
  std::size_t columns = 0;
  try {
    std::ifstream in = openText(nameOf(file), "cloud");
    forEachLine(in, "cloud", [&](std::string_view line, std::size_t) {
      std::string text(line);
      std::replace(text.begin(), text.end(), ',', ' ');
      const auto words = wordsOf(text);
      if (points.empty()) columns = words.size();
      if (words.size() < 3 || words.size() != columns) throw InputError("another number of columns");
      points.emplace_back(coordinateFrom(words[0]), coordinateFrom(words[1]), coordinateFrom(words[2]));
      checkPoints(points.size());
    });
  } catch (const InputError&) {
    return std::nullopt;
  }
  if (points.empty()) return std::nullopt;  // a file that was never written looks like this
  return points;
}

using Format = CObservationPointCloud::ExternalStorageFormat;

/// MRPT tells everything of the file but its format.
struct FormatOf : CObservationPointCloud {
  static Format of(const CObservationPointCloud& cloud) { return cloud.*&FormatOf::m_externally_stored; }
};

}  // namespace

std::optional<PointCloud> readExternalCloud(const CObservationPointCloud& cloud,
                                            const std::filesystem::path& folder) {
  const ExternalFile file(folder, cloud.getExternalStorageFile());
  switch (FormatOf::of(cloud)) {
    case Format::MRPT_Serialization:
      return readMap(file);
    case Format::KittiBinFile:
      return readRecords(file);
    case Format::PlainTextFile:
      return readText(file);
    case Format::None:
      break;
  }
  return std::nullopt;  // a format that is not known
}

}  // namespace hoctomap
