// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "PoseText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Manifest.h"

// The byte level of the index of nodes (NodeIndex.h), shared by its writer and its reader only.
namespace hoctomap::index_bytes {

static_assert(std::endian::native == std::endian::little, "the index is little endian");
static_assert(std::numeric_limits<double>::is_iec559);

inline constexpr std::size_t kPoseNumbers = 12;  // the upper three rows

/// Puts values at the end of a text.
class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}

  template <class T>
  void value(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    out_.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT: bytes of a number
  }
  void text(const std::string& text) {
    value(static_cast<std::uint32_t>(text.size()));
    out_ += text;
  }
  void pose(const Pose& pose) {
    const auto numbers = matrixNumbers(pose);
    for (std::size_t i = 0; i < kPoseNumbers; ++i) value(numbers.at(i));
  }
  template <class T>
  void resize(const std::vector<T>& list) {
    value(static_cast<std::uint32_t>(list.size()));
  }

 private:
  std::string& out_;
};

/// Takes values off a text. Numbers are finite.
/// @throws MapError, beginning with `name`, where it runs past the end or a value is impossible.
class Reader {
 public:
  Reader(std::string_view in, std::size_t at, const std::string& name) : in_(in), at_(at), name_(name) {}

  [[noreturn]] void refuse(const std::string& what) const { throw MapError(name_ + ": " + what); }

  template <class T>
  void value(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    require(sizeof value);
    std::memcpy(&value, in_.data() + at_, sizeof value);
    at_ += sizeof value;
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) refuse("a number is not finite");
    }
  }
  void text(std::string& text) {
    std::uint32_t length = 0;
    value(length);
    require(length);
    text = in_.substr(at_, length);
    at_ += length;
  }
  void pose(Pose& pose) {
    std::array<double, 16> numbers{};
    numbers.back() = 1.0;
    for (std::size_t i = 0; i < kPoseNumbers; ++i) value(numbers.at(i));
    try {
      pose = poseFromNumbers(numbers);
    } catch (const std::invalid_argument& error) {
      refuse(error.what());
    }
  }
  /// Makes room for as many as the text says and can hold.
  template <class T>
  void resize(std::vector<T>& list) {
    std::uint32_t count = 0;
    value(count);
    require(count);
    list.resize(count);
  }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  void require(std::size_t bytes) const {
    if (bytes > in_.size() - at_) refuse("ends too early");
  }

  std::string_view in_;
  std::size_t at_;
  const std::string& name_;
};

/// A flag is a byte.
template <class Io, class Flag>
void transferFlag(Io& io, Flag& flag) {
  std::uint8_t byte = flag ? 1 : 0;
  io.value(byte);
  if constexpr (!std::is_const_v<Flag>) flag = byte != 0;
}

template <class Io, class Optional, class Transfer>
void transferOptional(Io& io, Optional& optional, const Transfer& transfer) {
  bool there = optional.has_value();
  transferFlag(io, there);
  if constexpr (!std::is_const_v<Optional>) {
    if (there) optional.emplace();
  }
  if (there) transfer(*optional);
}

template <class Io, class File>
void transferFile(Io& io, File& file) {
  io.text(file.path);
  io.value(file.bytes);
  io.text(file.sha256);
}

/// Writes a record, or reads one: the same values in the same order.
template <class Io, class Record>
void transfer(Io& io, Record& node) {
  io.value(node.id.value);
  io.text(node.label.name);
  transferOptional(io, node.parent, [&](auto& parent) { io.value(parent.value); });
  io.resize(node.children);
  for (auto& child : node.children) io.value(child.value);
  io.pose(node.parent_T_node);
  io.pose(node.world_T_node);
  for (auto* number : {&node.resolution, &node.existence, &node.existence_log_odds}) io.value(*number);
  for (auto* vector : {&node.box_center, &node.box_half_extents}) {
    for (int axis = 0; axis < 3; ++axis) io.value((*vector)[axis]);
  }
  for (auto* count : {&node.voxels.occupied, &node.voxels.free, &node.memory_bytes, &node.first_scan,
                      &node.last_scan, &node.version, &node.edition, &node.votes.apart, &node.votes.joined,
                      &node.confirmation.shown, &node.confirmation.missed, &node.confirmation.points}) {
    io.value(*count);
  }
  io.value(node.votes.with.value);
  for (auto* flag : {&node.confirmation.waits, &node.confirmation.entered_at_end, &node.confirmation.enough})
    transferFlag(io, *flag);
  for (auto* probability : {&node.occupancy.prob_hit, &node.occupancy.prob_miss, &node.occupancy.clamping_min,
                            &node.occupancy.clamping_max, &node.occupancy.occupancy_threshold}) {
    io.value(*probability);
  }
  transferFile(io, node.ot);
  transferFile(io, node.bt);
  transferOptional(io, node.removed_scan, [&](auto& scan) { io.value(scan); });
}

}  // namespace hoctomap::index_bytes
