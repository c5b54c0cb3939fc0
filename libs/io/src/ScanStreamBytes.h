// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "hoctomap/io/PoseTrack.h"
#include "hoctomap/io/ScanStream.h"

// The byte level of ScanStream.h, shared by its writer and its reader only.
namespace hoctomap::stream_bytes {

static_assert(std::endian::native == std::endian::little, "the scan stream is little endian");
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);

inline constexpr char kMagic[8] = {'H', 'O', 'C', 'T', 'S', 'C', 'A', 'N'};
inline constexpr std::uint32_t kVersion = 3;
inline constexpr std::size_t kPreambleBytes = sizeof(kMagic) + sizeof(kVersion);
inline constexpr std::size_t kFrameHeaderBytes = 32;

inline constexpr std::size_t kBytesAColour = 3;
static_assert(sizeof(std::array<std::uint8_t, 3>) == kBytesAColour);

enum class FrameType : std::uint32_t {
  header = 1,
  depth,
  cloud,
  motion,
  skipped,
  warning,
  truth,
  error,
  end
};

class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>& out) : out_(out) {}

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes(&value, sizeof value);
  }
  void bytes(const void* from, std::size_t count) {
    const auto* first = static_cast<const std::uint8_t*>(from);
    out_.insert(out_.end(), first, first + count);
  }
  void string(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes(text.data(), text.size());
  }
  void pose(const Pose& pose) {
    const Eigen::Matrix4d m = toIsometry(pose).matrix();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) put(m(row, column));
    }
  }

 private:
  std::vector<std::uint8_t>& out_;
};

/// Takes values off a payload; running past its end is an InputError.
class Reader {
 public:
  Reader(const std::vector<std::uint8_t>& in, const StreamLimits& limits) : in_(in), limits_(limits) {}

  template <class T>
  [[nodiscard]] T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    bytes(&value, sizeof value);
    return value;
  }
  void bytes(void* into, std::size_t count) {
    if (count > left()) throw InputError("scan stream: a message ends too early");
    if (count > 0) std::memcpy(into, in_.data() + at_, count);
    at_ += count;
  }
  [[nodiscard]] std::string string() {
    const auto length = get<std::uint32_t>();
    if (length > limits_.max_string_bytes) throw LimitError("scan stream: a text is too long");
    if (length > left()) throw InputError("scan stream: a message ends too early");
    std::string text(length, '\0');
    bytes(text.data(), length);
    return text;
  }
  [[nodiscard]] double finite() {
    const auto value = get<double>();
    if (!std::isfinite(value)) throw InputError("scan stream: a number is not finite");
    return value;
  }
  [[nodiscard]] Pose pose() {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) m(row, column) = get<double>();
    }
    return poseFromInput(m, "pose in the scan stream");
  }
  [[nodiscard]] std::size_t left() const { return in_.size() - at_; }
  void finish() const {
    if (left() != 0) throw InputError("scan stream: a message is longer than its content");
  }

 private:
  const std::vector<std::uint8_t>& in_;
  const StreamLimits& limits_;
  std::size_t at_ = 0;
};

}  // namespace hoctomap::stream_bytes
