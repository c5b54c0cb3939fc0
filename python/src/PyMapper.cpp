// SPDX-License-Identifier: BSD-3-Clause
#include "PyMapper.h"

#include <stdexcept>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/mapping/ScanPipeline.h"

namespace hoctomap::python {

/// The right to use the mapper, for as long as it lives.
class PyMapper::Turn {
 public:
  explicit Turn(PyMapper& mapper) : mapper_(mapper) {
    if (mapper.busy_.exchange(true))
      throw std::runtime_error("the mapper is at work: it serves one call at a time");
    if (mapper.failed_) {
      mapper.busy_ = false;
      throw std::runtime_error("an earlier scan has failed half way: the map is not whole");
    }
  }
  ~Turn() { mapper_.busy_ = false; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  PyMapper& mapper_;
};

PyMapper::PyMapper(Settings settings, MappingStrategies strategies)
    : settings_(std::move(settings)),
      mapper_(settings_.mappingConfig(), settings_.labels, std::move(strategies)) {}

void PyMapper::number(NumberedMeasurement& measurement) {
  if (!measurement.has_number) {
    measurement.z.scan = next_number_;
    measurement.has_number = true;
  }
  if (measurement.z.scan < next_number_)
    throw std::invalid_argument("scan " + std::to_string(measurement.z.scan) +
                                " comes too late: numbers of scans ascend");
  next_number_ = measurement.z.scan + 1;
}

UpdateReport PyMapper::integrate(NumberedMeasurement& measurement) {
  const Turn turn(*this);
  number(measurement);
  return integrate(measurement.z, mapper_.prepare(measurement.z));
}

std::vector<UpdateReport> PyMapper::run(MeasurementSource& source) {
  const Turn turn(*this);
  const std::size_t before = reports_.size();
  ScanPipeline pipeline(source, mapper_);
  while (auto item = pipeline.next())
    integrate(std::get<Measurement>(item->item), std::move(*item->prepared));
  return {reports_.begin() + static_cast<std::ptrdiff_t>(before), reports_.end()};
}

UpdateReport PyMapper::integrate(const Measurement& z, PreparedScan prepared) {
  if (end_) throw std::runtime_error("the mapper has finished");
  failed_ = true;
  UpdateReport report = mapper_.integrate(z, std::move(prepared));
  failed_ = false;
  scans_ = z.scan + 1;
  last_stamp_ = z.stamp;
  ++mapped_;
  return keep(std::move(report));
}

UpdateReport PyMapper::move(NodeId node, const Pose& motion) {
  const Turn turn(*this);
  if (end_) throw std::runtime_error("the mapper has finished");
  return keep(mapper_.integrate(ObjectMotion{last_stamp_, node, motion}, scans_));
}

UpdateReport PyMapper::finish() {
  const Turn turn(*this);
  if (!end_) {
    end_ = scans_ == 0 ? UpdateReport() : mapper_.finish(scans_ - 1, last_stamp_);
    map_.reset();
  }
  return *end_;
}

const UpdateReport& PyMapper::keep(UpdateReport report) {
  map_.reset();
  return reports_.emplace_back(std::move(report));
}

std::shared_ptr<Map> PyMapper::map() {
  const Turn turn(*this);
  if (map_ == nullptr) map_ = std::make_shared<Map>(copyOf(mapper_.hierarchy()), scans_);
  return map_;
}

void PyMapper::save(const std::filesystem::path& directory, bool overwrite) {
  const Turn turn(*this);
  MapDirectory session(directory, {overwrite ? MapOpenMode::overwrite : MapOpenMode::create,
                                   toIni(settings_),
                                   "hoctomap " HOCTOMAP_VERSION,
                                   {}});
  for (const UpdateReport& report : reports_) session.append(report);
  if (end_) session.appendEnd(*end_);
  session.commit({.hierarchy = mapper_.hierarchy(),
                  .removed = mapper_.removed(),
                  .scans = scans_,
                  .last_stamp = last_stamp_,
                  .seams = &mapper_.seams(),
                  .sensor = mapper_.sensor(),
                  .mapped_scans = mapped_});
}

}  // namespace hoctomap::python
