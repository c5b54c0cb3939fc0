// SPDX-License-Identifier: BSD-3-Clause
#include "CloudReader.h"

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

void dropNotFinite(CloudScan& cloud) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.sensor_points.size(); ++i) {
    if (!cloud.sensor_points[i].allFinite()) continue;
    cloud.sensor_points[kept] = cloud.sensor_points[i];
    if (!cloud.colours.empty()) cloud.colours[kept] = cloud.colours[i];
    ++kept;
  }
  cloud.sensor_points.resize(kept);
  if (!cloud.colours.empty()) cloud.colours.resize(kept);
}

}  // namespace

CloudScan CloudReader::read(const std::filesystem::path& file) {
  if (!child_) {
    child_ = std::make_unique<ChildProcess>(ChildProcess::Options{.program = findHelper("hoctomap-cloud"),
                                                                  .arguments = {},
                                                                  .input = ChildProcess::Stream::pipe,
                                                                  .output = ChildProcess::Stream::pipe});
    requests_ = std::make_unique<ScanStreamWriter>(child_->inputFd());
    answers_ = std::make_unique<ScanStreamReader>(child_->outputFd());
  }
  const std::string name = escapedText(file.string());
  StreamMessage answer;
  try {
    requests_->write(StreamWarning{file.string()});
    answer = answers_->read();
  } catch (const Error&) {
    child_.reset();
    throw InputError(name + ": the reader of clouds broke down over this file");
  }
  if (const auto* error = std::get_if<StreamError>(&answer)) throwStreamError(*error);
  auto* cloud = std::get_if<CloudScan>(&answer);
  if (cloud == nullptr) throw InputError(name + ": the reader of clouds gave no cloud");
  dropNotFinite(*cloud);
  return std::move(*cloud);
}

}  // namespace hoctomap
