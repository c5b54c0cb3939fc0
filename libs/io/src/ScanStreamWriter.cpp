// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "PipeWrite.h"
#include "ScanStreamBytes.h"

namespace hoctomap {

using namespace stream_bytes;

namespace {

/// Appends the payload of each kind of message and names its type.
struct Encoder {
  Writer& out;

  FrameType operator()(const StreamHeader& m) const {
    out.put(m.total_scans);
    out.put(m.chosen_scans);
    out.string(m.pose_source);
    out.put(static_cast<std::uint32_t>(m.log_sha256.size()));
    for (const auto& hash : m.log_sha256) out.string(hash);
    out.put(static_cast<std::uint32_t>(m.sensors.size()));
    for (const auto& sensor : m.sensors) {
      out.string(sensor.label);
      out.string(sensor.type);
      out.put(sensor.scans);
      out.put(sensor.width);
      out.put(sensor.height);
    }
    return FrameType::header;
  }
  FrameType operator()(const DepthScan& m) const {
    const PinholeCamera& camera = m.image.camera;
    if (m.image.depth.size() !=
        static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height))
      throw std::invalid_argument("scan stream: image and camera differ in size");
    scanHead(m);
    out.put(static_cast<std::uint32_t>(camera.width));
    out.put(static_cast<std::uint32_t>(camera.height));
    for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) out.put(value);
    out.bytes(m.image.depth.data(), m.image.depth.size() * sizeof(float));
    if (m.colour.rgb.size() !=
        3 * static_cast<std::size_t>(m.colour.width) * static_cast<std::size_t>(m.colour.height))
      throw std::invalid_argument("scan stream: a picture of the wrong size");
    out.put(static_cast<std::uint32_t>(m.colour.width));
    out.put(static_cast<std::uint32_t>(m.colour.height));
    out.bytes(m.colour.rgb.data(), m.colour.rgb.size());
    return FrameType::depth;
  }
  FrameType operator()(const CloudScan& m) const {
    static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
    scanHead(m);
    out.put(std::uint64_t{m.sensor_points.size()});
    out.bytes(m.sensor_points.data(), m.sensor_points.size() * sizeof(Eigen::Vector3f));
    if (!m.colours.empty() && m.colours.size() != m.sensor_points.size())
      throw std::invalid_argument("scan stream: points and colours differ in number");
    out.put(std::uint64_t{m.colours.size()});
    out.bytes(m.colours.data(), m.colours.size() * kBytesAColour);
    return FrameType::cloud;
  }
  FrameType operator()(const ObjectMotion& m) const {
    out.put(m.stamp);
    out.put(m.node.value);
    out.pose(m.motion);
    return FrameType::motion;
  }
  FrameType operator()(const SkippedScan& m) const {
    out.put(m.scan);
    out.put(m.stamp);
    out.string(m.reason);
    return FrameType::skipped;
  }
  FrameType operator()(const StreamWarning& m) const {
    out.string(m.text);
    return FrameType::warning;
  }
  FrameType operator()(const TruthPose& m) const {
    out.put(m.stamp);
    out.string(m.label);
    out.pose(m.world_T_base);
    return FrameType::truth;
  }
  FrameType operator()(const StreamError& m) const {
    out.put(static_cast<std::uint32_t>(m.exit_code));
    out.string(m.text);
    return FrameType::error;
  }
  FrameType operator()(const StreamEnd& m) const {
    out.put(m.used);
    out.put(m.skipped);
    return FrameType::end;
  }

  template <class Scan>
  void scanHead(const Scan& m) const {
    out.put(m.scan);
    out.put(m.stamp);
    out.string(m.sensor);
    out.pose(m.world_T_sensor);
  }
};

}  // namespace

ScanStreamWriter::ScanStreamWriter(int fd) : fd_(fd) {
  Writer out(frame_);
  out.bytes(kMagic, sizeof kMagic);
  out.put(kVersion);
  send();
  frame_.clear();
}

void ScanStreamWriter::send() const {
  if (const int error = writeToPipe(fd_, frame_.data(), frame_.size()))
    throw FileError(std::string("scan stream: cannot write: ") + std::strerror(error));
}

void ScanStreamWriter::write(const StreamMessage& message, const StreamPosition& position) {
  frame_.assign(kFrameHeaderBytes, 0);
  Writer out(frame_);
  const FrameType type = std::visit(Encoder{out}, message);

  std::vector<std::uint8_t> head;
  Writer header(head);
  header.put(static_cast<std::uint32_t>(type));
  header.put(static_cast<std::uint32_t>(frame_.size() - kFrameHeaderBytes));
  header.put(position.log);
  header.put(std::uint32_t{0});
  header.put(position.object);
  header.put(position.offset);
  std::memcpy(frame_.data(), head.data(), kFrameHeaderBytes);

  send();
}

void sendErrorFromSignalHandler(int fd, int exit_code, const char* text,
                                const StreamPosition& position) noexcept {
  // No memory may be taken here: the frame is laid out by hand.
  unsigned char frame[kFrameHeaderBytes + 8 + 1000] = {};
  const auto put = [&](std::size_t at, const auto& value) { std::memcpy(frame + at, &value, sizeof value); };
  const auto length = static_cast<std::uint32_t>(std::min<std::size_t>(std::strlen(text), 1000));
  put(0, static_cast<std::uint32_t>(FrameType::error));
  put(4, length + 8);
  put(8, position.log);
  put(16, position.object);
  put(24, position.offset);
  put(kFrameHeaderBytes, static_cast<std::uint32_t>(exit_code));
  put(kFrameHeaderBytes + 4, length);
  std::memcpy(frame + kFrameHeaderBytes + 8, text, length);
  const std::size_t total = kFrameHeaderBytes + 8 + length;
  for (std::size_t sent = 0; sent < total;) {
    const ssize_t n = ::write(fd, frame + sent, total - sent);
    if (n <= 0) return;
    sent += static_cast<std::size_t>(n);
  }
}

}  // namespace hoctomap
