// SPDX-License-Identifier: BSD-3-Clause
#include "RayBatch.h"

#include "LaneMath.h"

namespace hoctomap::engine {

namespace {

/// Four rays, axis by axis: see `Ray`, whose arithmetic this repeats to the last bit.
struct Rays {
  Doubles next[3];
  Doubles delta[3];
  Doubles steps[3];
  Codes forward[3];  ///< masks of the step's sign
  Codes backward[3];
};

/// Crossings of an axis before the time t. `doubt` is set where that is too close to call without the exact
/// times: they differ from these by less than 1e-6 of a step.
HOCTOMAP_INLINE Doubles crossingsBefore(const Doubles& t, const Doubles& next, const Doubles& delta,
                                        Codes& doubt) {
  constexpr double kClose = 1e-5;
  Doubles q = (t - next) / delta;
  q = q > -0.5 ? q : Doubles{} - 0.5;
  q = q < 1e6 ? q : Doubles{} + 1e6;
  const Doubles down = floorOf(q);
  const Doubles fraction = q - down;
  doubt |= (fraction < kClose) | (fraction > 1.0 - kClose);
  return down + 1.0;
}

/// Cuts the rays to the box. @param taken out: steps taken on entering, by axis.
HOCTOMAP_INLINE void cut(const RayFan& fan, const Rays& rays, Codes& live, Codes& doubt, Doubles taken[3],
                         Doubles& cells) {
  constexpr double kNever = 1e300;
  Doubles enter = Doubles{} - kNever;
  Doubles leave = Doubles{} + kNever;
  Doubles total = rays.steps[0] + rays.steps[1] + rays.steps[2];
  Doubles needed_in[3] = {};
  Doubles time_in[3];
  Doubles needed_out[3];
  Doubles time_out[3];
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const RayFan::Axis& axis = fan.axes[i];
    time_in[i] = Doubles{} - kNever;
    if (!axis.inside) {
      inside = false;
      needed_in[i] = either(rays.forward[i], Doubles{} + axis.before[1], Doubles{} + axis.before[0]);
      live &= (needed_in[i] > 0.0) & (needed_in[i] <= rays.steps[i]);
      time_in[i] = rays.next[i] + (needed_in[i] - 1.0) * rays.delta[i];
      enter = greater(enter, time_in[i]);
    }
    needed_out[i] = either(rays.forward[i], Doubles{} + axis.leave[1], Doubles{} + axis.leave[0]);
    const Codes leaves = needed_out[i] <= rays.steps[i];
    time_out[i] = either(leaves, rays.next[i] + (needed_out[i] - 1.0) * rays.delta[i], Doubles{} + kNever);
    leave = lesser(leave, time_out[i]);
  }
  live &= enter <
          leave * (1.0 + 1e-9) + 1e-9;  // what is close is in doubt below, where the crossings are counted
  if (!anyOf(live)) return;

  Doubles first = Doubles{};
  for (std::size_t i = 0; i < 3; ++i) taken[i] = Doubles{};
  if (!inside) {
    Codes found{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Codes here = time_in[i] == enter;
      Codes close{};
      const Doubles others = crossingsBefore(enter, rays.next[i], rays.delta[i], close);
      doubt |= (close & ~here) | (here & found);
      found |= here;
      taken[i] = either(here, needed_in[i], others);
      first += taken[i];
    }
  }
  const Codes ends_inside = leave >= kNever;
  Doubles last = Doubles{};
  if (anyOf(~ends_inside)) {
    Codes found{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Codes here = time_out[i] == leave;
      Codes close{};
      const Doubles t = either(ends_inside, Doubles{}, leave);
      const Doubles others = crossingsBefore(t, rays.next[i], rays.delta[i], close);
      doubt |= ~ends_inside & ((close & ~here) | (here & found));
      found |= here;
      last += either(here, needed_out[i] - 1.0, others);
    }
  }
  last = either(ends_inside, total - 1.0, last);
  cells = last - first + 1.0;
}

/// False if no ray of the batch can come near the box.
HOCTOMAP_INLINE Codes nearBox(const RayFan& fan, const Floats end[3]) {
  Doubles enters{};
  Doubles leaves = Doubles{} + 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const RayFan::Axis& axis = fan.axes[i];
    // Divided by zero: minus to plus infinity for an origin between the planes (the padding keeps it off
    // them).
    const Doubles inverse = 1.0 / (toDoubles(end[i]) - static_cast<double>(axis.origin));
    const Doubles a = axis.to_pad[0] * inverse;
    const Doubles b = axis.to_pad[1] * inverse;
    enters = greater(enters, lesser(a, b));
    leaves = lesser(leaves, greater(a, b));
  }
  return enters <= leaves;
}

/// Leaves out the first part of rays from inside the box. A ray for which it is not certain where that ends
/// stays whole.
HOCTOMAP_INLINE void leaveOut(const Ends& ends, const Rays& rays, Doubles taken[3], Doubles& cells) {
  Doubles time{};
  Codes skips{};
  Doubles skip[3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      skip[i][lane] = ends.skip_axis[lane] == i ? ends.skip_steps[lane] : 0.0;
    }
    const Codes here = skip[i] > 0.0;
    time = either(here, rays.next[i] + (skip[i] - 1.0) * rays.delta[i], time);
    skips |= here;
    cells = either(here & (skip[i] > rays.steps[i]), Doubles{}, cells);
  }
  Doubles first{};
  Codes doubt{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Codes here = skip[i] > 0.0;
    Codes close{};
    const Doubles others = crossingsBefore(time, rays.next[i], rays.delta[i], close);
    doubt |= close & ~here;
    taken[i] = either(here, skip[i], others);
    first += taken[i];
  }
  skips &= ~doubt;
  for (std::size_t i = 0; i < 3; ++i) taken[i] = either(skips, taken[i], Doubles{});
  cells -= either(skips, first, Doubles{});
}

HOCTOMAP_INLINE void prepare(const RayFan& fan, const Ends& ends, RayBatch& batch) {
  const std::size_t count = ends.count;
  Floats end[3];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Eigen::Vector3f& p = ends.points[lane < count ? lane : 0];
    end[0][lane] = p[0];
    end[1][lane] = p[1];
    end[2][lane] = p[2];
    batch.state[lane] = RayBatch::State::none;
  }
  Codes live = Codes{0, 1, 2, 3} < static_cast<Code>(count);
  if (fan.bounded) {
    live &= nearBox(fan, end);
    if (!anyOf(live)) return;
  }

  // Keys, as VoxelGrid::checkedKey.
  Doubles distance[3];
  Codes valid = live;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles cell = fan.cells_per_metre * toDoubles(end[i]);
    const Codes in_range = (cell >= -kKeyOffset) & (cell < kKeyOffset);
    valid &= in_range;
    const Doubles key = floorOf(either(in_range, cell, Doubles{})) + kKeyOffset;
    distance[i] = key - fan.axes[i].key;
  }
  live = valid & ((distance[0] != 0.0) | (distance[1] != 0.0) | (distance[2] != 0.0));

  // Times, as RayCaster::prepare.
  const Floats dx = end[0] - fan.axes[0].origin;
  const Floats dy = end[1] - fan.axes[1].origin;
  const Floats dz = end[2] - fan.axes[2].origin;
  const Floats square = dx * dx + dy * dy + dz * dz;
  const Floats length = __builtin_convertvector(rootOf(toDoubles(square)), Floats);
  const Floats direction[3] = {dx / length, dy / length, dz / length};
  Rays rays;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles d = toDoubles(direction[i]);
    rays.forward[i] = d > 0.0;
    rays.backward[i] = d < 0.0;
    rays.steps[i] = magnitude(distance[i]);
    const Codes moves = rays.forward[i] | rays.backward[i];
    const Doubles to_border =
        either(rays.forward[i], Doubles{} + fan.axes[i].to_border[1], Doubles{} + fan.axes[i].to_border[0]);
    constexpr double kMax = std::numeric_limits<double>::max();
    rays.next[i] = either(moves, to_border / d, Doubles{} + kMax);
    rays.delta[i] = either(moves, fan.resolution / magnitude(d), Doubles{} + kMax);
  }

  // Regular, as isRegular.
  Codes regular = live;
  Doubles last{};
  Doubles beyond = Doubles{} + std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Codes stays = distance[i] == 0.0;
    regular &= stays | ((distance[i] > 0.0) & rays.forward[i]) | ((distance[i] < 0.0) & rays.backward[i]);
    const Doubles crossing = rays.next[i] + (rays.steps[i] - 1.0) * rays.delta[i];
    last = either(stays, last, greater(last, crossing));
    beyond = lesser(beyond, either(stays, rays.next[i], crossing + rays.delta[i]));
  }
  const Doubles certain = last + 1e-10 * (1.0 + last);
  regular &= (certain < beyond) & (certain < toDoubles(length));

  Codes special = live & ~regular;
  live &= regular;
  Doubles taken[3] = {Doubles{}, Doubles{}, Doubles{}};
  Doubles cells = rays.steps[0] + rays.steps[1] + rays.steps[2];
  if (fan.bounded) {
    Codes doubt{};
    cut(fan, rays, live, doubt, taken, cells);
    special |= live & doubt;
    live &= ~doubt;
  }
  if (ends.skips) leaveOut(ends, rays, taken, cells);
  if (fan.bounded || ends.skips) {
    live &= cells > 0.0;
    Doubles crossings[3] = {either(live, taken[0], Doubles{}), either(live, taken[1], Doubles{}),
                            either(live, taken[2], Doubles{})};
    addRepeatedlyLanes(rays.next, rays.delta, crossings);
  }

  Codes mirror{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Codes steps = toCodes(either(live, taken[i], Doubles{}));
    const Codes signed_steps = (steps ^ rays.backward[i]) - rays.backward[i];
    const Codes local = (fan.axes[i].local + signed_steps) & 0xFFFF;
    const Codes flipped = rays.backward[i] & fan.mirror_places & kAxisPlaces[i];
    mirror |= flipped;
    batch.start.place[i] = ((dilateLanes(local) << static_cast<Code>(i)) ^ flipped) | ~kAxisPlaces[i];
    batch.start.next[i] = rays.next[i];
    batch.start.delta[i] = rays.delta[i];
  }
  batch.start.mirror = mirror;
  const Ints whole = __builtin_convertvector(either(live, cells, Doubles{}), Ints);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    batch.cells[lane] = whole[lane];
    if (live[lane] != 0) batch.state[lane] = RayBatch::State::ready;
    if (special[lane] != 0) batch.state[lane] = RayBatch::State::special;
  }
}

void prepareBaseline(const RayFan& fan, const Ends& ends, RayBatch& batch) {
  prepare(fan, ends, batch);
}

HOCTOMAP_TARGET_AVX2 void prepareAvx2(const RayFan& fan, const Ends& ends, RayBatch& batch) {
  prepare(fan, ends, batch);
}

}  // namespace

RayFan::RayFan(const VoxelGrid& grid, const Eigen::Vector3f& origin, const KeyBox& box,
               const BlockFrame& frame, bool is_bounded)
    : axes{},
      resolution(grid.resolution()),
      cells_per_metre(grid.cellsPerMetre()),
      bounded(is_bounded),
      mirror_places((Code{1} << (3 * frame.levels() + kBlockCodeBits)) - 1) {
  // A cell that octomap visits lies within one voxel of the beam: its rounding is a hundredth of a voxel.
  constexpr int kPadding = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    Axis& axis = axes[i];
    axis.origin = origin[static_cast<Eigen::Index>(i)];
    const double at = axis.origin;
    const int key = grid.checkedKey(at);
    axis.key = key;
    axis.to_border[0] = grid.border(key, -1) - at;
    axis.to_border[1] = grid.border(key, 1) - at;
    axis.to_pad[0] = grid.center(box.min[i] - kPadding) - at;
    axis.to_pad[1] = grid.center(box.max[i] + kPadding) - at;
    axis.inside = key >= box.min[i] && key <= box.max[i];
    axis.before[0] = key - box.max[i];
    axis.before[1] = box.min[i] - key;
    axis.leave[0] = 1 + key - box.min[i];
    axis.leave[1] = 1 + box.max[i] - key;
    axis.local = key - frame.corner()[i];
  }
}

void placeRay(const RayFan& fan, const Ray& ray, const Stretch& stretch, Traversals& start) {
  start.mirror[0] = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t local = fan.axes[i].local + ray.step[i] * stretch.start.taken[i];
    const Code mirrored = ray.step[i] < 0 ? fan.mirror_places & kAxisPlaces[i] : 0;
    start.next[i][0] = stretch.start.next[i];
    start.delta[i][0] = ray.delta[i];
    start.place[i][0] = ((dilate(static_cast<int>(local)) << i) ^ mirrored) | ~kAxisPlaces[i];
    start.mirror[0] |= mirrored;
  }
}

PrepareRays choosePrepareRays(bool best_instructions) {
  return best_instructions && hasAvx2() ? &prepareAvx2 : &prepareBaseline;
}

}  // namespace hoctomap::engine
