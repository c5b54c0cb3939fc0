// SPDX-License-Identifier: BSD-3-Clause
#include "EndpointMarker.h"

#include <algorithm>

#include "LaneMath.h"

namespace hoctomap::engine {

namespace {

using Doubles = Lanes<kNarrowLanes>::Doubles;
using Codes = Lanes<kNarrowLanes>::Codes;
using Floats = Lanes<kNarrowLanes>::Floats;

/// Local codes of some points; -1 for those that are not marked.
HOCTOMAP_INLINE void codesOf(const EndpointField& field, const Floats p[3], Codes& codes) {
  Codes inside = ~Codes{};
  codes = Codes{};
  for (std::size_t i = 0; i < 3; ++i) {
    // As VoxelGrid::checkedKey; also false for what is not a number.
    const Doubles cell = field.cells_per_metre * __builtin_convertvector(p[i], Doubles);
    const Doubles local = floorOf(cell) + field.to_local[i];
    const Codes here = (local >= field.first[i]) & (local <= field.last[i]);
    inside &= here;
    codes |= dilateLanes(toCodes(either(here, local, Doubles{}))) << static_cast<Code>(i);
  }
  if (field.max_range >= 0.0) {  // as ScanBeams::isTooLong
    const Floats dx = p[0] - field.origin[0];
    const Floats dy = p[1] - field.origin[1];
    const Floats dz = p[2] - field.origin[2];
    const Floats square = dx * dx + dy * dy + dz * dz;
    inside &= ~(rootOf(__builtin_convertvector(square, Doubles)) > field.max_range);
  }
  codes |= ~inside;
}

HOCTOMAP_INLINE void mark(const EndpointField& field, std::span<const Eigen::Vector3f> points,
                          VoxelBits& bits) {
  for (std::size_t first = 0; first < points.size(); first += kNarrowLanes) {
    float coordinates[3][kNarrowLanes];
    for (std::size_t lane = 0; lane < kNarrowLanes; ++lane) {
      // The last point fills the lanes: marking a voxel again does no harm.
      const Eigen::Vector3f& point = points[std::min(first + lane, points.size() - 1)];
      for (std::size_t i = 0; i < 3; ++i) coordinates[i][lane] = point[static_cast<Eigen::Index>(i)];
    }
    Floats p[3];
    for (std::size_t i = 0; i < 3; ++i) load(p[i], coordinates[i]);
    Codes codes;
    codesOf(field, p, codes);
    for (std::size_t lane = 0; lane < kNarrowLanes; ++lane) {
      if (codes[lane] >= 0) bits.mark(codes[lane]);
    }
  }
}

void markBaseline(const EndpointField& field, std::span<const Eigen::Vector3f> points, VoxelBits& bits) {
  mark(field, points, bits);
}

HOCTOMAP_TARGET_AVX2 void markAvx2(const EndpointField& field, std::span<const Eigen::Vector3f> points,
                                   VoxelBits& bits) {
  mark(field, points, bits);
}

}  // namespace

EndpointField::EndpointField(const VoxelGrid& grid, const Eigen::Vector3f& from, double range,
                             const KeyBox& box, const BlockFrame& frame)
    : cells_per_metre(grid.cellsPerMetre()),
      to_local{},
      first{},
      last{},
      origin{from.x(), from.y(), from.z()},
      max_range(range) {
  for (std::size_t i = 0; i < 3; ++i) {
    to_local[i] = kKeyOffset - frame.corner()[i];
    first[i] = box.min[i] - frame.corner()[i];
    last[i] = box.max[i] - frame.corner()[i];
  }
}

MarkEndpoints chooseMarkEndpoints(InstructionSet set) {
  return set == InstructionSet::baseline ? &markBaseline : &markAvx2;
}

}  // namespace hoctomap::engine
