// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include <utility>

#include "MappingSetup.h"
#include "hoctomap/tabletop/Tabletop.h"
#include "measuring/Scans.h"

namespace hoctomap {

namespace {

std::vector<Measurement> allScans(const std::filesystem::path& log) {
  ScanChoice choice;
  choice.log = log;
  return readScans(choice);
}

}  // namespace

BenchmarkInput::BenchmarkInput(std::filesystem::path log)
    : log_(std::move(log)),
      settings_(loadSettings(std::nullopt)),
      scans_(allScans(log_)),
      mapper_(settings_.mappingConfig(), settings_.labels, makeStrategies(settings_)) {
  for (std::size_t i = 0; i + 1 < scans_.size(); ++i) static_cast<void>(mapper_.integrate(scans_[i]));
}

std::vector<PartOfScan> BenchmarkInput::partsOfLastScan() const {
  const auto segmentation = makeSegmentation(settings_);
  const auto labeling = makeTabletopLabeling();
  std::vector<PartOfScan> parts;
  for (const Segment& segment : segmentation->segment(lastScan())) {
    if (segment.points.empty()) continue;
    PartOfScan part{labeling->label(lastScan(), segment), {}, {}};
    for (const auto i : segment.points) part.world_points.push_back(lastScan().world_points[i]);
    part.box = pcaBox(part.world_points);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace hoctomap
