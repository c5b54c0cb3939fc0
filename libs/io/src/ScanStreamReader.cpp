// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <new>

#include "ScanStreamBytes.h"

namespace hoctomap {

using namespace stream_bytes;

namespace {

/// The longest payload that a message within `limits` can have.
std::uint64_t maxPayload(const StreamLimits& limits) {
  const std::uint64_t texts = 4 * std::uint64_t{limits.max_string_bytes} + 4096;
  return limits.max_points * (sizeof(Eigen::Vector3f) + kBytesAColour) + texts;
}

StreamHeader headerFrom(Reader& in, const StreamLimits& limits) {
  StreamHeader m;
  m.total_scans = in.get<std::uint64_t>();
  m.chosen_scans = in.get<std::uint64_t>();
  m.pose_source = in.string();
  const auto logs = in.get<std::uint32_t>();
  if (logs > limits.max_logs) throw LimitError("scan stream: too many logs");
  for (std::uint32_t i = 0; i < logs; ++i) m.log_sha256.push_back(in.string());
  const auto count = in.get<std::uint32_t>();
  if (count > limits.max_sensors) throw LimitError("scan stream: too many sensors");
  for (std::uint32_t i = 0; i < count; ++i) {
    StreamHeader::Sensor& sensor = m.sensors.emplace_back();
    sensor.label = in.string();
    sensor.type = in.string();
    sensor.scans = in.get<std::uint64_t>();
    sensor.width = in.get<std::uint32_t>();
    sensor.height = in.get<std::uint32_t>();
  }
  return m;
}

template <class Scan>
Scan scanHead(Reader& in) {
  Scan m;
  m.scan = in.get<std::uint64_t>();
  m.stamp = in.finite();
  m.sensor = in.string();
  m.world_T_sensor = in.pose();
  return m;
}

ColourImage colourFrom(Reader& in, const StreamLimits& limits) {
  const std::uint64_t width = in.get<std::uint32_t>();
  const std::uint64_t height = in.get<std::uint32_t>();
  if ((width == 0) != (height == 0)) throw InputError("scan stream: an empty picture");
  if (height > 0 && width > limits.max_points / height)
    throw LimitError("scan stream: a picture has too many pixels");
  if (in.left() != width * height * kBytesAColour)
    throw InputError("scan stream: a picture of the wrong size");
  ColourImage colour{static_cast<int>(width), static_cast<int>(height), {}};
  colour.rgb.resize(in.left());
  in.bytes(colour.rgb.data(), colour.rgb.size());
  return colour;
}

DepthScan depthFrom(Reader& in, const StreamLimits& limits) {
  auto m = scanHead<DepthScan>(in);
  const std::uint64_t width = in.get<std::uint32_t>();
  const std::uint64_t height = in.get<std::uint32_t>();
  if (width == 0 || height == 0) throw InputError("scan stream: an empty image");
  if (width * height > limits.max_points) throw LimitError("scan stream: an image has too many pixels");
  PinholeCamera& camera = m.image.camera;
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = in.finite();
  if (camera.fx <= 0.0 || camera.fy <= 0.0) throw InputError("scan stream: a focal length is not positive");
  if (in.left() < width * height * sizeof(float)) throw InputError("scan stream: an image of the wrong size");
  m.image.depth.resize(width * height);
  in.bytes(m.image.depth.data(), width * height * sizeof(float));
  m.colour = colourFrom(in, limits);
  return m;
}

CloudScan cloudFrom(Reader& in, const StreamLimits& limits) {
  auto m = scanHead<CloudScan>(in);
  const auto count = in.get<std::uint64_t>();
  if (count > limits.max_points) throw LimitError("scan stream: a cloud has too many points");
  if (in.left() < count * sizeof(Eigen::Vector3f)) throw InputError("scan stream: a cloud of the wrong size");
  m.sensor_points.resize(count);
  in.bytes(m.sensor_points.data(), count * sizeof(Eigen::Vector3f));
  const auto colours = in.get<std::uint64_t>();
  if ((colours != 0 && colours != count) || in.left() != colours * kBytesAColour)
    throw InputError("scan stream: colours of the wrong number");
  m.colours.resize(colours);
  in.bytes(m.colours.data(), colours * kBytesAColour);
  return m;
}

ObjectMotion motionFrom(Reader& in) {
  ObjectMotion m;
  m.stamp = in.finite();
  m.node = NodeId{in.get<std::uint32_t>()};
  m.motion = in.pose();
  return m;
}

SkippedScan skippedFrom(Reader& in) {
  SkippedScan m;
  m.scan = in.get<std::uint64_t>();
  m.stamp = in.finite();
  m.reason = in.string();
  return m;
}

TruthPose truthFrom(Reader& in) {
  TruthPose m;
  m.stamp = in.finite();
  m.label = in.string();
  m.world_T_base = in.pose();
  return m;
}

StreamError errorFrom(Reader& in) {
  StreamError m;
  const auto code = in.get<std::uint32_t>();
  if (code < 1 || code > 255) throw InputError("scan stream: an exit code out of range");
  m.exit_code = static_cast<int>(code);
  m.text = in.string();
  return m;
}

StreamMessage messageFrom(FrameType type, Reader& in, const StreamLimits& limits) {
  switch (type) {
    case FrameType::header:
      return headerFrom(in, limits);
    case FrameType::depth:
      return depthFrom(in, limits);
    case FrameType::cloud:
      return cloudFrom(in, limits);
    case FrameType::motion:
      return motionFrom(in);
    case FrameType::skipped:
      return skippedFrom(in);
    case FrameType::warning:
      return StreamWarning{in.string()};
    case FrameType::truth:
      return truthFrom(in);
    case FrameType::error:
      return errorFrom(in);
    case FrameType::end: {
      const auto used = in.get<std::uint64_t>();
      return StreamEnd{used, in.get<std::uint64_t>()};
    }
  }
  throw InputError("scan stream: unknown message type " + std::to_string(static_cast<std::uint32_t>(type)));
}

}  // namespace

ScanStreamReader::ScanStreamReader(int fd, StreamLimits limits) : fd_(fd), limits_(limits) {}

StreamMessage ScanStreamReader::read() {
  if (!preamble_read_) readPreamble();
  std::vector<std::uint8_t> head(kFrameHeaderBytes);
  readFully(head.data(), head.size());
  Reader header(head, limits_);
  const auto type = static_cast<FrameType>(header.get<std::uint32_t>());
  const auto bytes = header.get<std::uint32_t>();
  const auto log = header.get<std::uint32_t>();
  if (header.get<std::uint32_t>() != 0) throw InputError("scan stream: malformed message");
  const auto object = header.get<std::uint64_t>();
  position_ = {log, object, header.get<std::uint64_t>()};
  if (bytes > maxPayload(limits_)) throw LimitError("scan stream: a message is too long");

  payload_.resize(bytes);
  readFully(payload_.data(), bytes);
  Reader payload(payload_, limits_);
  StreamMessage message = messageFrom(type, payload, limits_);
  payload.finish();
  return message;
}

void ScanStreamReader::readPreamble() {
  std::vector<std::uint8_t> bytes(kPreambleBytes);
  readFully(bytes.data(), bytes.size());
  Reader in(bytes, limits_);
  char magic[sizeof kMagic];
  in.bytes(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof kMagic) != 0) throw InputError("scan stream: not a scan stream");
  if (const auto version = in.get<std::uint32_t>(); version != kVersion)
    throw InputError("scan stream: version " + std::to_string(version) + " instead of " +
                     std::to_string(kVersion) + ": hoctomap and hoctomap-mrpt are not of one build");
  preamble_read_ = true;
}

void ScanStreamReader::readFully(void* into, std::size_t bytes) {
  auto* to = static_cast<std::uint8_t*>(into);
  while (bytes > 0) {
    const ssize_t n = ::read(fd_, to, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw FileError(std::string("scan stream: cannot read: ") + std::strerror(errno));
    if (n == 0) throw InputError("scan stream: ends before its end message");
    to += n;
    bytes -= static_cast<std::size_t>(n);
  }
}

void throwStreamError(const StreamError& error) {
  switch (error.exit_code) {
    case 2:
      throw ConfigError(error.text);
    case 4:
      throw MapError(error.text);
    case 5:
      throw FileError(error.text);
    case 6:
      throw LimitError(error.text);
    default:
      throw InputError(error.text);
  }
}

int exitCodeOf(const std::exception& error) {
  if (dynamic_cast<const ConfigError*>(&error)) return 2;
  if (dynamic_cast<const MapError*>(&error)) return 4;
  if (dynamic_cast<const FileError*>(&error)) return 5;
  if (dynamic_cast<const LimitError*>(&error)) return 6;
  if (dynamic_cast<const std::bad_alloc*>(&error)) return 6;
  return 3;
}

}  // namespace hoctomap
