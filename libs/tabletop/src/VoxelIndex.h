// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hoctomap {

/// Largest integers not above; |p| < 2^31. Without SSE 4.1 std::floor is a call of the library.
inline Eigen::Vector3i floorOf(const Eigen::Vector3d& p) {
  const auto down = [](double x) {
    const int truncated = static_cast<int>(x);
    return truncated - (x < truncated ? 1 : 0);
  };
  return {down(p.x()), down(p.y()), down(p.z())};
}

/// Numbers the voxels that hold something, in the order in which they are first met. A hash table with open
/// addressing: the searches of this library spend their time here.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  explicit VoxelIndex(std::size_t expected = 1024) {
    std::size_t capacity = 64;
    while (capacity < 2 * expected) capacity *= 2;
    slots_.assign(capacity, kNone);
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] const Eigen::Vector3i& key(std::uint32_t id) const { return keys_[id]; }

  /// Number of the voxel, `kNone` if it holds nothing.
  [[nodiscard]] std::uint32_t find(const Eigen::Vector3i& key) const { return slots_[slotOf(key)]; }

  /// Number of the voxel, a new one if it held nothing.
  std::uint32_t insert(const Eigen::Vector3i& key) {
    std::size_t slot = slotOf(key);
    if (slots_[slot] != kNone) return slots_[slot];
    if (2 * (keys_.size() + 1) > slots_.size()) {
      grow();
      slot = slotOf(key);
    }
    slots_[slot] = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    return slots_[slot];
  }

 private:
  [[nodiscard]] std::size_t slotOf(const Eigen::Vector3i& key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(key) & mask;
    while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
    return slot;
  }

  static std::size_t hash(const Eigen::Vector3i& key) {
    // Odd multipliers, then a fold: neighbouring voxels must not fall into one run of slots.
    std::uint64_t h = static_cast<std::uint32_t>(key.x()) * std::uint64_t{0x9E3779B97F4A7C15};
    h ^= static_cast<std::uint32_t>(key.y()) * std::uint64_t{0xC2B2AE3D27D4EB4F};
    h ^= static_cast<std::uint32_t>(key.z()) * std::uint64_t{0x165667B19E3779F9};
    h ^= h >> 29;
    return static_cast<std::size_t>(h ^ (h >> 43));
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kNone);
    for (std::uint32_t id = 0; id < keys_.size(); ++id) slots_[slotOf(keys_[id])] = id;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Eigen::Vector3i> keys_;
};

}  // namespace hoctomap
